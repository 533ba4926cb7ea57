// What SolveService does with several solves at a time.
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "server/service/label_check.h"
#include "server/service/request_check.h"
#include "server/service/solve_message.h"
#include "server/service/solve_service.h"

namespace rollgait::server {
namespace {

// Of all specs of a batch, with the stored models that they name in them and their warm starts. The first one is taken
// whatever its length, so that halves of a batch are taken in the end.
constexpr int64_t kMaxBatchBytes = 16 << 20;

std::string Index(const char* field, int i) { return std::string(field) + "[" + std::to_string(i) + "]"; }

// How many there are, and request_ids that occur twice.
Violations CheckBatch(const v1::BatchCreateSolvesRequest& request, int most) {
  const int count = request.requests_size();
  if (count < 1 || count > most) {
    return {{"requests", "are " + std::to_string(count) + ", must be from 1 to " + std::to_string(most)}};
  }
  std::map<std::string, int> known;
  for (int i = 0; i < count; ++i) {
    const v1::CreateSolveRequest& one = request.requests(i);
    const std::string path = Index("requests", i);
    if (one.validate_only()) return {{path + ".validate_only", "is set; set that of the batch"}};
    if (one.spell_out()) return {{path + ".spell_out", "is set; ask for it with CreateSolve"}};
    const auto [place, is_new] = known.emplace(one.request_id(), i);
    if (!is_new && !one.request_id().empty()) {
      return {{path + ".request_id", "is that of " + Index("requests", place->second) + " too; give each its own"}};
    }
  }
  return {};
}

Error CarriedBy(const std::string& solves) {
  return InvalidArgument({{"labels", "are carried by " + solves + "; ListSolves lists them"}});
}

// The error of one of several requests.
Error OfRequest(Error error, int index) {
  const std::string prefix = Index("requests", index) + ".";
  if (error.violations.empty()) return error;
  AddPrefix(prefix, error.violations);
  return InvalidArgument(std::move(error.violations));
}

}  // namespace

Outcome<NewSolve> SolveService::MakeOneOf(const Caller& caller, const v1::CreateSolveRequest& request, int64_t* bytes) {
  const bool names_stored = ModelService::IsStored(request.spec().model());
  v1::CreateSolveRequest resolved;
  if (names_stored) {
    resolved = request;
    std::optional<Error> refusal = models_.Resolve(caller, "spec.model.", resolved.mutable_spec()->mutable_model());
    if (refusal.has_value()) return *std::move(refusal);
    Violations violations = CheckRequest(resolved);
    if (!violations.empty()) return InvalidArgument(std::move(violations));
  }
  Outcome<NewSolve> solve = MakeNew(caller, names_stored ? resolved : request);
  if (!solve.ok()) return solve;
  const bool is_first = *bytes == 0;
  *bytes += static_cast<int64_t>(solve.value().spec.size() + solve.value().warm_start.size());
  if (!is_first && *bytes > kMaxBatchBytes) {
    return InvalidArgument({{"spec", "makes the batch, with stored models and warm starts, " + std::to_string(*bytes) +
                                         " bytes long up to here, the limit is " + std::to_string(kMaxBatchBytes) +
                                         " bytes; send it in several batches"}});
  }
  return solve;
}

Outcome<v1::BatchCreateSolvesResponse> SolveService::BatchCreateSolves(const Caller& caller,
                                                                       const v1::BatchCreateSolvesRequest& request,
                                                                       int* attached) {
  Violations violations = CheckRequest(request);
  if (violations.empty()) violations = CheckBatch(request, kMostAtOnce);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  std::vector<NewSolve> solves;
  int64_t bytes = 0;
  for (int i = 0; i < request.requests_size(); ++i) {
    Outcome<NewSolve> solve = MakeOneOf(caller, request.requests(i), &bytes);
    if (!solve.ok()) return OfRequest(solve.error(), i);
    solves.push_back(std::move(solve).value());
  }
  v1::BatchCreateSolvesResponse response;
  if (request.validate_only()) {
    for (const v1::CreateSolveRequest& one : request.requests()) {
      *response.add_solves()->mutable_spec() = one.spec();
      *response.mutable_solves()->rbegin()->mutable_labels() = one.labels();
      response.mutable_solves()->rbegin()->set_priority(one.priority());
    }
    return response;
  }
  if (std::optional<Error> full = full_queue_.Refusal(caller.tenant)) {
    for (const NewSolve& solve : solves) {
      const Outcome<bool> needs_place = store_.NeedsPlace(solve);
      if (!needs_place.ok()) return needs_place.error();
      if (needs_place.value()) return *std::move(full);
    }
  }
  const Outcome<std::vector<CreatedSolve>> created = store_.CreateAll(solves);
  if (!created.ok()) return created.error();
  for (const CreatedSolve& one : created.value()) {
    Announce(one);
    if (attached != nullptr && !one.created) ++*attached;
    Outcome<v1::Solve> solve = ToSolve(one.record);
    if (!solve.ok()) return solve.error();
    *response.add_solves() = std::move(solve).value();
  }
  return response;
}

Outcome<std::vector<WatchPosition>> SolveService::FindLabelled(const Caller& caller,
                                                               const v1::WatchSolvesRequest& request) {
  Violations violations;
  ListQuery query{kMostAtOnce + 1, "", std::nullopt, caller.sees()};
  query.filter.labels = ReadLabels(request.labels(), kMostFilterLabels, "", &violations);
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  std::vector<WatchPosition> positions;
  do {
    const Outcome<SolvePage> page = store_.List(query);
    if (!page.ok()) return page.error();
    for (const SolveRecord& record : page.value().records) positions.push_back({record.id, record.trimmed_sequence});
    query.page_token = page.value().next_page_token;
  } while (!query.page_token.empty() && positions.size() <= static_cast<size_t>(kMostAtOnce));
  if (positions.empty()) return CarriedBy("none of your solves");
  if (positions.size() > static_cast<size_t>(kMostAtOnce)) {
    return CarriedBy("more than " + std::to_string(kMostAtOnce) + " of your solves, the most that are watched at once");
  }
  return positions;
}

Outcome<SolveService::Watched> SolveService::FindWatched(const Caller& caller, const v1::WatchSolvesRequest& request) {
  Violations violations = CheckRequest(request);
  const int count = request.solves_size();
  if (violations.empty() && (count > 0) == (request.labels_size() > 0)) {
    violations.push_back({"solves", count > 0 ? "are named besides labels; give one of both"
                                              : "are 0 and there are no labels; give one of both"});
  }
  if (count > kMostAtOnce) {
    violations.push_back({"solves", "are " + std::to_string(count) + ", the limit is " + std::to_string(kMostAtOnce)});
  }
  if (!violations.empty()) return InvalidArgument(std::move(violations));
  Watched watched;
  if (count == 0) {
    Outcome<std::vector<WatchPosition>> labelled = FindLabelled(caller, request);
    if (!labelled.ok()) return labelled.error();
    watched.positions = std::move(labelled).value();
  }
  std::set<std::string> known;
  for (int i = 0; i < count; ++i) {
    const v1::WatchSolveRequest& one = request.solves(i);
    Outcome<std::string> id = SolveId(one.name());
    if (!id.ok()) return id.error();
    if (!known.insert(id.value()).second) {
      return InvalidArgument({{Index("solves", i) + ".name", "is named a second time; name each solve once"}});
    }
    Violations refused = CheckIterates(one.iterates_per_second(), Index("solves", i) + ".iterates_per_second");
    if (!refused.empty()) return InvalidArgument(std::move(refused));
    watched.positions.push_back({std::move(id).value(), one.after_sequence(), one.iterates_per_second()});
  }
  const bool by_labels = count == 0;
  std::vector<WatchPosition> there;
  for (WatchPosition& position : watched.positions) {
    const Outcome<SolveExtent> extent = ExtentFor(caller, position.id);
    // Deleted since it was found.
    if (by_labels && !extent.ok() && extent.error().code == ErrorCode::kNotFound) continue;
    if (!extent.ok()) return extent.error();
    watched.longest_bytes = std::max(watched.longest_bytes, extent.value().bytes);
    there.push_back(std::move(position));
  }
  if (there.empty()) return CarriedBy("none of your solves");
  watched.positions = std::move(there);
  return watched;
}

}  // namespace rollgait::server
