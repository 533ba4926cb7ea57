#include "server/service/solve_service.h"

#include <google/protobuf/util/time_util.h>
#include <spdlog/common.h>

#include <utility>

#include "server/base/logging.h"
#include "server/service/filter_check.h"
#include "server/service/label_check.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"
#include "server/service/solve_message.h"
#include "server/store/spec_model.h"

namespace rollgait::server {
namespace {

// In the store's words, so that another tenant's solve cannot be told from none.
Error NoSuchSolve(const std::string& id) {
  return {ErrorCode::kNotFound, "there is no solve \"" + SolveName(id) + "\"; ListSolves lists those that are"};
}

v1::Caller Describe(const Caller& caller) {
  v1::Caller described;
  described.set_authentication(static_cast<v1::Caller::Authentication>(caller.authentication));
  described.set_tenant(caller.tenant);
  described.set_identity(caller.identity);
  for (const Scope scope : {kScopeRead, kScopeSolve, kScopeAdmin}) {
    if ((caller.scopes & scope) != 0) described.add_scopes(ScopeNames(scope));
  }
  described.mutable_limits()->set_max_queued(caller.limits.max_queued);
  described.mutable_limits()->set_max_running(caller.limits.max_running);
  described.mutable_limits()->set_max_watches(caller.limits.max_watches);
  described.mutable_limits()->set_creates_per_s(caller.limits.creates_per_s);
  return described;
}

// Whose solves ListSolves shows; nullopt: everyone's.
Outcome<std::optional<std::string>> TenantToList(const Caller& caller, const std::string& asked) {
  if (asked.empty()) return caller.sees();
  const bool all = asked == "-";
  if (all ? !caller.administers() : !caller.reaches(asked)) {
    return Error{ErrorCode::kPermissionDenied, "tenant is \"" + asked.substr(0, 100) + "\", yours is \"" +
                                                   caller.tenant +
                                                   "\"; to list the solves of others a token needs the scope admin"};
  }
  return all ? std::nullopt : std::optional(asked);
}

}  // namespace

SolveService::SolveService(SolveStore& store, ModelStore& models, GaitKnowledge knowledge, ServiceOptions options,
                           std::function<void(const std::string& id)> announce)
    : store_(store),
      knowledge_(std::move(knowledge)),
      models_(models, knowledge_),
      options_(std::move(options)),
      announce_(std::move(announce)) {}

Outcome<SolveService::Checked> SolveService::CheckSpec(const Caller& caller, const v1::SolveSpec& spec, bool has_spec) {
  if (!has_spec) return InvalidArgument({{"spec", "is missing; set at least spec.model.name"}});
  const Result<v1::Model> model = knowledge_.check_spec(spec);
  if (!model.ok()) {
    Violations violations = model.violations();
    AddPrefix("spec.", violations);
    return InvalidArgument(std::move(violations));
  }
  Outcome<std::optional<FoundWarmStart>> start = FindWarmStart(store_, knowledge_, spec, caller.sees());
  if (!start.ok()) return start.error();
  Checked checked{std::move(start).value(), ""};
  if (!options_.reuse_results) return checked;
  // Minima are local: what is found depends on the start, whichever way the request named it.
  v1::SolveSpec question = spec;
  question.clear_warm_start();
  checked.key = SolveKey(question, model.value(), options_.solver_build + " " + options_.solver_fingerprint,
                         checked.warm_start ? checked.warm_start->identity : "", caller.tenant);
  return checked;
}

Outcome<CreatedSolve> SolveService::Store(const NewSolve& solve) {
  if (std::optional<Error> full = full_queue_.Refusal(solve.actor.tenant)) {
    const Outcome<bool> needs_place = store_.NeedsPlace(solve);
    if (!needs_place.ok()) return needs_place.error();
    if (needs_place.value()) return *std::move(full);
  }
  Outcome<CreatedSolve> created = store_.Create(solve);
  if (!created.ok()) full_queue_.Note(solve.actor.tenant, created.error());
  return created;
}

Outcome<v1::Solve> SolveService::CreateSolve(const Caller& caller, const v1::CreateSolveRequest& request) {
  if (!ModelService::IsStored(request.spec().model())) return CreateResolved(caller, request);
  v1::CreateSolveRequest resolved = request;
  std::optional<Error> refusal = models_.Resolve(caller, "spec.model.", resolved.mutable_spec()->mutable_model());
  if (refusal.has_value()) return *std::move(refusal);
  return CreateResolved(caller, resolved);
}

Outcome<v1::Solve> SolveService::CreateResolved(const Caller& caller, const v1::CreateSolveRequest& request) {
  Violations violations = CheckRequest(request);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  const Outcome<NewSolve> solve = MakeNew(caller, request);
  if (!solve.ok()) return solve.error();
  if (request.validate_only()) {
    v1::Solve checked;
    *checked.mutable_spec() = request.spell_out() ? knowledge_.spell_out(request.spec()).value() : request.spec();
    *checked.mutable_labels() = request.labels();
    checked.set_priority(request.priority());
    return checked;
  }
  const Outcome<CreatedSolve> created = Store(solve.value());
  if (!created.ok()) return created.error();
  Announce(created.value());
  return ToSolve(created.value().record);
}

void SolveService::Announce(const CreatedSolve& created) {
  if (!created.created) return;
  const SolveRecord& record = created.record;
  LogEvent(spdlog::level::info, "solve.created", {{"solve", record.id}, {"from_cache", record.from_cache}});
  announce_(record.id);
}

Outcome<NewSolve> SolveService::MakeNew(const Caller& caller, const v1::CreateSolveRequest& request) {
  Violations violations = CheckRequestId(request.request_id());
  if (request.spell_out() && !request.validate_only()) {
    violations.push_back({"spell_out", "needs validate_only; nothing that is stored is spelled out"});
  }
  Violations priority = CheckPriority(request.priority());
  violations.insert(violations.end(), priority.begin(), priority.end());
  Labels labels = ReadLabels(request.labels(), kMostLabels, "", &violations);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  Outcome<Checked> checked = CheckSpec(caller, request.spec(), request.has_spec());
  if (!checked.ok()) return checked.error();
  NewSolve solve{options_.new_id(), request.request_id(), CanonicalBytes(request.spec()), checked.value().key,
                 options_.max_queued};
  solve.actor = caller.actor();
  solve.traceparent = caller.traceparent;
  solve.max_queued_tenant = caller.limits.max_queued;
  solve.max_bytes_tenant = caller.limits.max_storage_bytes;
  if (checked.value().warm_start) solve.warm_start = checked.value().warm_start->payload;
  solve.place = PlaceOf(request.spec());
  solve.solver_fingerprint = options_.solver_fingerprint;
  solve.labels = std::move(labels);
  solve.priority = request.priority();
  solve.model = ModelOf(request.spec());
  return solve;
}

Outcome<SolveBytes> SolveService::GetSolve(const Caller& caller, const v1::GetSolveRequest& request,
                                           const std::function<Outcome<Done>(int64_t bytes)>& hold) {
  const Outcome<std::string> id = SolveId(request.name());
  if (!id.ok()) return id.error();
  const Outcome<SolveExtent> extent = ExtentFor(caller, id.value());
  if (!extent.ok()) return extent.error();
  const Outcome<Done> held = hold(extent.value().bytes);
  if (!held.ok()) return held.error();
  Outcome<SolveRecord> record = store_.Get(id.value());
  if (!record.ok()) return record.error();
  return ToSolveBytes(std::move(record).value());
}

Outcome<v1::ListSolvesResponse> SolveService::ListSolves(const Caller& caller, const v1::ListSolvesRequest& request) {
  Violations violations = CheckRequest(request);
  ListQuery query{CheckPageSize(request.page_size(), &violations), request.page_token(), std::nullopt};
  if (violations.empty()) ReadFilter(request, &query, &violations);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  const Outcome<std::optional<std::string>> tenant = TenantToList(caller, request.tenant());
  if (!tenant.ok()) return tenant.error();
  query.tenant = tenant.value();
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

Outcome<v1::Solve> SolveService::CancelSolve(const Caller& caller, const v1::CancelSolveRequest& request) {
  const Outcome<std::string> id = FindFor(caller, request.name());
  if (!id.ok()) return id.error();
  const Outcome<SolveRecord> record = store_.RequestCancel(id.value(), caller.actor());
  if (!record.ok()) return record.error();
  if (record.value().cancel_requested) {
    LogEvent(spdlog::level::info, IsTerminal(record.value().state) ? "solve.cancelled" : "solve.cancel_requested",
             {{"solve", id.value()}});
    announce_(id.value());
  }
  return ToSolve(record.value());
}

Outcome<v1::Solve> SolveService::SetSolvePriority(const Caller& caller, const v1::SetSolvePriorityRequest& request) {
  Violations violations = CheckPriority(request.priority());
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  const Outcome<std::string> id = FindFor(caller, request.name());
  if (!id.ok()) return id.error();
  const Outcome<SolveRecord> record = store_.SetPriority(id.value(), request.priority(), caller.actor());
  if (!record.ok()) return record.error();
  LogEvent(spdlog::level::info, "solve.priority_set", {{"solve", id.value()}, {"priority", request.priority()}});
  return ToSolve(record.value());
}

Outcome<google::protobuf::Empty> SolveService::DeleteSolve(const Caller& caller,
                                                           const v1::DeleteSolveRequest& request) {
  const Outcome<std::string> id = FindFor(caller, request.name());
  if (!id.ok()) return id.error();
  const Outcome<Done> done = store_.Delete(id.value(), caller.actor());
  if (!done.ok()) return done.error();
  LogEvent(spdlog::level::info, "solve.deleted", {{"solve", id.value()}});
  return google::protobuf::Empty();
}

Outcome<v1::ServerInfo> SolveService::GetServerInfo(const Caller& caller, const v1::GetServerInfoRequest&) {
  // How busy others are is the administrator's to know.
  const Outcome<SolveCounts> counts = store_.Counts(caller.administers() ? std::nullopt : caller.sees());
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
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  *info.mutable_server_time() = google::protobuf::util::TimeUtil::NanosecondsToTimestamp(
      std::chrono::duration_cast<std::chrono::nanoseconds>(now).count());
  info.set_max_queued(options_.max_queued);
  // The machine is the administrator's, too.
  const std::optional<int64_t> free = caller.administers() ? options_.store_disk.FreeBytes() : std::nullopt;
  if (free) info.set_store_free_bytes(*free);
  *info.mutable_caller() = Describe(caller);
  return info;
}

Outcome<std::string> SolveService::FindFor(const Caller& caller, const std::string& name) {
  Outcome<std::string> id = SolveId(name);
  if (!id.ok() || !caller.sees() || caller.administers()) return id;
  const Outcome<SolveExtent> extent = ExtentFor(caller, id.value());
  if (!extent.ok()) return extent.error();
  return id;
}

Outcome<SolveExtent> SolveService::ExtentFor(const Caller& caller, const std::string& id) {
  Outcome<SolveExtent> extent = store_.Extent(id);
  if (!extent.ok()) return extent;
  if (!caller.reaches(extent.value().tenant)) return NoSuchSolve(id);
  return extent;
}

}  // namespace rollgait::server
