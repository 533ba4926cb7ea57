// Side files, beside a robot that does not change: refused by field, or a model that weighs what the robot does.
#include "rollgait/v1/model_side_file.pb.h"
#include "tests/fuzz/import_check.h"

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
    CheckMass(tree, client::ModelOfTree(tree, "fuzz.json", side).model);
  } catch (const client::Failure& failure) {
    ROLLGAIT_CHECK(failure.code() == client::ExitCode::kUsage && failure.what()[0] != '\0');
    ROLLGAIT_CHECK(std::string(failure.what()).size() < 4000);
  }
  return 0;
}
