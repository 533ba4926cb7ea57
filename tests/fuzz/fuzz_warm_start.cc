// The stored solution that a warm start begins with.
#include "rollgait/v1/solve.pb.h"
#include "server/convert/gait_request_convert.h"
#include "server/convert/warm_start_convert.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return fuzz::MutateAsMessage<v1::SolveResult>(data, size, max_size, seed);
}

extern "C" size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size) {
  return fuzz::SeedAsBytes<v1::SolveResult>(data, size, max_size);
}

namespace {

GaitSpec Spec() {
  v1::SolveSpec message;
  message.mutable_model()->set_name("planar");
  return server::DecodeSpec(message).value();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const GaitSpec spec = Spec();
  static v1::SolveResult result;  // its memory is used again
  if (!fuzz::ParseInput(data, size, &result)) return 0;
  const Result<WarmStart> start = server::DecodeWarmStart(result.trajectory(), result.multipliers(), spec);
  if (start.ok()) return 0;
  for (const Violation& violation : start.violations()) {
    ROLLGAIT_CHECK(violation.field == "warm_start" && !violation.message.empty());
  }
  return 0;
}
