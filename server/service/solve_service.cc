#include "server/service/solve_service.h"

#include <spdlog/spdlog.h>

#include <utility>

#include "server/base/digest.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"
#include "server/service/solve_message.h"

namespace rollgait::server {
namespace {

// What is wrong with any request, whatever its type.
Violations CheckRequest(const google::protobuf::Message& request) {
  Violations violations = CheckSize(request);
  if (violations.empty()) violations = CheckWellFormed(request, "");
  return violations;
}

void AddPrefix(const std::string& prefix, Violations& violations) {
  for (Violation& violation : violations) violation.field.insert(0, prefix);
}

}  // namespace

SolveService::SolveService(SolveStore& store, GaitKnowledge knowledge, ServiceOptions options,
                           std::function<void(const std::string& id)> announce)
    : store_(store), knowledge_(std::move(knowledge)), options_(std::move(options)), announce_(std::move(announce)) {}

Outcome<SolveService::Checked> SolveService::CheckSpec(const v1::SolveSpec& spec, bool has_spec) {
  if (!has_spec) return InvalidArgument({{"spec", "is missing; set at least spec.model.name"}});
  const Result<v1::Model> model = knowledge_.check_spec(spec);
  if (!model.ok()) {
    Violations violations = model.violations();
    AddPrefix("spec.", violations);
    return InvalidArgument(std::move(violations));
  }
  Outcome<std::optional<FoundWarmStart>> start = FindWarmStart(store_, knowledge_, spec);
  if (!start.ok()) return start.error();
  Checked checked{std::move(start).value(), ""};
  if (!options_.reuse_results) return checked;
  // Minima are local: what is found depends on the start, whichever way the request named it.
  v1::SolveSpec question = spec;
  question.clear_warm_start();
  checked.key = SolveKey(question, model.value(), options_.solver_build + " " + options_.solver_fingerprint,
                         checked.warm_start ? checked.warm_start->identity : "");
  return checked;
}

Outcome<v1::Solve> SolveService::CreateSolve(const v1::CreateSolveRequest& request) {
  Violations violations = CheckRequest(request);
  if (violations.empty()) violations = CheckRequestId(request.request_id());
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  Outcome<Checked> checked = CheckSpec(request.spec(), request.has_spec());
  if (!checked.ok()) return checked.error();
  if (request.validate_only()) {
    v1::Solve solve;
    *solve.mutable_spec() = request.spec();
    return solve;
  }
  NewSolve solve{RandomId(), request.request_id(), CanonicalBytes(request.spec()), checked.value().key, options_.max_queued};
  if (checked.value().warm_start) solve.warm_start = checked.value().warm_start->payload;
  solve.solver_fingerprint = options_.solver_fingerprint;
  const Outcome<CreatedSolve> created = store_.Create(solve);
  if (!created.ok()) return created.error();
  const SolveRecord& record = created.value().record;
  if (created.value().created) {
    spdlog::info("solves/{} created{}", record.id, record.from_cache ? ", answered from the store" : "");
    announce_(record.id);
  }
  return ToSolve(record);
}

Outcome<v1::Solve> SolveService::GetSolve(const v1::GetSolveRequest& request) {
  const Outcome<std::string> id = SolveId(request.name());
  if (!id.ok()) return id.error();
  const Outcome<SolveRecord> record = store_.Get(id.value());
  if (!record.ok()) return record.error();
  return ToSolve(record.value());
}

Outcome<v1::ListSolvesResponse> SolveService::ListSolves(const v1::ListSolvesRequest& request) {
  constexpr int kDefaultPage = 50, kMaxPage = 1000;
  Violations violations = CheckRequest(request);
  if (request.page_size() < 0 || request.page_size() > kMaxPage) {
    violations.push_back({"page_size", "is " + std::to_string(request.page_size()) + ", must be from 1 to " +
                                           std::to_string(kMaxPage) + " (0: " + std::to_string(kDefaultPage) + ")"});
  }
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  ListQuery query{request.page_size() == 0 ? kDefaultPage : request.page_size(), request.page_token(), std::nullopt};
  if (request.state() != v1::SOLVE_STATE_UNSPECIFIED) query.state = static_cast<SolveState>(request.state());
  const Outcome<SolvePage> page = store_.List(query);
  if (!page.ok()) return page.error();
  v1::ListSolvesResponse response;
  for (const SolveRecord& record : page.value().records) {
    Outcome<v1::Solve> solve = ToSolve(record);
    if (!solve.ok()) return solve.error();
    *response.add_solves() = std::move(solve).value();
  }
  response.set_next_page_token(page.value().next_page_token);
  return response;
}

Outcome<v1::Solve> SolveService::CancelSolve(const v1::CancelSolveRequest& request) {
  const Outcome<std::string> id = SolveId(request.name());
  if (!id.ok()) return id.error();
  const Outcome<SolveRecord> record = store_.RequestCancel(id.value());
  if (!record.ok()) return record.error();
  if (record.value().cancel_requested) {
    spdlog::info("solves/{} {}", id.value(), IsTerminal(record.value().state) ? "cancelled" : "is to be cancelled");
    announce_(id.value());
  }
  return ToSolve(record.value());
}

Outcome<google::protobuf::Empty> SolveService::DeleteSolve(const v1::DeleteSolveRequest& request) {
  const Outcome<std::string> id = SolveId(request.name());
  if (!id.ok()) return id.error();
  const Outcome<Done> done = store_.Delete(id.value());
  if (!done.ok()) return done.error();
  spdlog::info("solves/{} deleted", id.value());
  return google::protobuf::Empty();
}

Outcome<v1::ListModelsResponse> SolveService::ListModels(const v1::ListModelsRequest&) {
  return knowledge_.list_models();
}

Outcome<v1::Model> SolveService::GetModel(const v1::GetModelRequest& request) {
  Violations violations = CheckRequest(request);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  const v1::ListModelsResponse models = knowledge_.list_models();
  std::string names;
  bool known = false;
  for (const v1::ModelSummary& summary : models.models()) {
    known = known || summary.name() == request.model().name();
    names += (names.empty() ? "" : ", ") + summary.name();
  }
  if (!known) {
    return Error{ErrorCode::kNotFound,
                 "there is no model \"" + request.model().name().substr(0, 100) + "\"; there are: " + names};
  }
  const Result<v1::Model> model = knowledge_.get_model(request.model());
  if (model.ok()) return model.value();
  violations = model.violations();
  AddPrefix("model.", violations);
  return InvalidArgument(std::move(violations));
}

Outcome<v1::ServerInfo> SolveService::GetServerInfo(const v1::GetServerInfoRequest&) {
  const Outcome<SolveCounts> counts = store_.Counts();
  if (!counts.ok()) return counts.error();
  v1::ServerInfo info;
  info.set_version(options_.version);
  info.set_solver_build(options_.solver_build);
  info.set_solver_slots(options_.solver_slots);
  info.set_running(counts.value().running);
  info.set_queued(counts.value().queued);
  info.set_max_request_bytes(kMaxRequestBytes);
  info.set_uptime_s(std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
  info.set_store(options_.store_name);
  return info;
}

}  // namespace rollgait::server
