// CreateSolveRequest as the service looks at it before anything is stored: decoding and every check, no solver.
#include "rollgait/v1/gait_service.pb.h"
#include "server/service/core_knowledge.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned seed) {
  return fuzz::MutateAsMessage<v1::CreateSolveRequest>(data, size, max_size, seed);
}

extern "C" size_t FuzzSeedToChange(uint8_t* data, size_t size, size_t max_size) {
  return fuzz::SeedAsBytes<v1::CreateSolveRequest>(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const server::GaitKnowledge knowledge = server::MakeCoreKnowledge();
  static v1::CreateSolveRequest request;  // its memory is used again
  if (!fuzz::ParseInput(data, size, &request)) return 0;
  Violations violations = server::CheckSize(request);
  if (violations.empty()) violations = server::CheckWellFormed(request, "");
  if (violations.empty()) violations = server::CheckRequestId(request.request_id());
  fuzz::CheckViolations(violations, *request.GetDescriptor());
  if (!violations.empty() || !request.has_spec()) return 0;
  const Result<v1::Model> model = knowledge.check_spec(request.spec());
  if (!model.ok()) {
    fuzz::CheckViolations(model.violations(), *request.spec().GetDescriptor());
    return 0;
  }
  ROLLGAIT_CHECK(!request.spec().model().name().empty());
  const std::string canonical = server::CanonicalBytes(request.spec());
  static v1::SolveSpec again;
  ROLLGAIT_CHECK(again.ParseFromString(canonical) && server::CanonicalBytes(again) == canonical);
  return 0;
}
