// Side files, beside a robot that does not change: refused by field, or a model that weighs what the robot does.
#include <cmath>

#include "client/failure.h"
#include "client/import/side_file.h"
#include "client/import/tree_file.h"
#include "client/import/tree_model.h"
#include "rollgait/v1/model_side_file.pb.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return fuzz::MutateAsMessage<v1::ModelSideFile>(data, size, max_size, seed);
}

extern "C" size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size) {
  return fuzz::SeedAsBytes<v1::ModelSideFile>(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const client::LinkTree tree = client::ReadLinkTree(ROLLGAIT_BIPED);
  static v1::ModelSideFile side;  // its memory is used again
  if (!fuzz::ParseInput(data, size, &side)) return 0;
  try {
    client::CheckSideFile("fuzz.json", side, tree);
    const v1::Model model = client::ModelOfTree(tree, "fuzz.json", side).model;
    double mass = 0, expected = 0;
    for (const v1::Joint& joint : model.joints()) mass += joint.mass_kg();
    for (const client::TreeLink& link : tree.links) expected += link.mass.mass;
    ROLLGAIT_CHECK(std::abs(mass - expected) <= 1e-9 * expected);
  } catch (const client::Failure& failure) {
    ROLLGAIT_CHECK(failure.code() == client::ExitCode::kUsage && failure.what()[0] != '\0');
    ROLLGAIT_CHECK(std::string(failure.what()).size() < 4000);
  }
  return 0;
}
