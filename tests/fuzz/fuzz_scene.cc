// SimulateRequest: scenes become mechanisms or are refused by field.
#include "rollgait/v1/simulation.pb.h"
#include "server/convert/scene_convert.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return fuzz::MutateAsMessage<v1::SimulateRequest>(data, size, max_size, seed);
}

extern "C" size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size) {
  return fuzz::SeedAsBytes<v1::SimulateRequest>(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static v1::SimulateRequest request;  // its memory is used again
  if (!fuzz::ParseInput(data, size, &request)) return 0;
  const Result<SimulationScene> scene = server::DecodeScene(request.scene());
  if (!scene.ok()) fuzz::CheckViolations(scene.violations(), *request.scene().GetDescriptor());
  return 0;
}
