// Models of users: a body is walked or refused by field, and one that is accepted is accepted again when it is written.
#include "core/models/own_model.h"
#include "rollgait/v1/model.pb.h"
#include "server/convert/model_convert.h"
#include "server/convert/own_model_convert.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return fuzz::MutateAsMessage<v1::Model>(data, size, max_size, seed);
}

extern "C" size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size) {
  return fuzz::SeedAsBytes<v1::Model>(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static v1::Model model;  // its memory is used again
  if (!fuzz::ParseInput(data, size, &model)) return 0;
  Violations violations;
  const auto own = server::DecodeOwnModel("", model, &violations);
  fuzz::CheckViolations(violations, *model.GetDescriptor());
  if (!violations.empty()) return 0;
  const Result<Scene> scene = OwnScene(*own);
  if (!scene.ok()) {
    fuzz::CheckViolations(scene.violations(), *model.GetDescriptor());
    return 0;
  }
  const v1::Model written = server::EncodeModel(scene.value(), 9.81);
  const auto again = server::DecodeOwnModel("", written, &violations);
  ROLLGAIT_CHECK(violations.empty());
  const Result<Scene> same = OwnScene(*again);
  ROLLGAIT_CHECK(same.ok() && same.value().model.size() == scene.value().model.size());
  return 0;
}
