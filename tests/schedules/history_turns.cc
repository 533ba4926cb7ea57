// HistoryModel: whose turn it was.
#include <algorithm>
#include <iterator>

#include "tests/schedules/history_model.h"

namespace rollgait::server {
namespace {

constexpr int kWaits = 1, kRuns = 2;  // v1::SolveState

}  // namespace

int HistoryModel::WeightOf(const std::string& tenant) const {
  const auto place = weights_.find(tenant);
  return place == weights_.end() ? 1 : place->second;
}

// It waited before, and no equal one ran.
bool HistoryModel::CouldRun(const SeenSolve& waiting) const {
  const auto place = solves_.find(waiting.id);
  if (place == solves_.end() || place->second.last.state != kWaits || waiting.state != kWaits) return false;
  return waiting.key.empty() || std::none_of(solves_.begin(), solves_.end(), [&waiting](const auto& entry) {
           return !entry.second.gone && entry.second.last.state == kRuns && entry.second.last.key == waiting.key;
         });
}

void HistoryModel::CheckTurn(const std::vector<SeenSolve>& solves) {
  const auto claimed = std::find_if(solves.begin(), solves.end(), [this](const SeenSolve& seen) {
    return seen.state == kRuns && StateOf(seen.id) == kWaits;
  });
  if (claimed == solves.end()) return;
  const std::string& served = claimed->tenant;
  std::set<std::string> waiting;
  for (const SeenSolve& seen : solves) {
    if (!CouldRun(seen)) continue;
    if (seen.tenant != served) waiting.insert(seen.tenant);
    // What another transaction holds at the moment is passed over.
    const bool earlier =
        seen.priority != claimed->priority ? seen.priority > claimed->priority : seen.number < claimed->number;
    if (claimers_ == 1 && seen.tenant == served && earlier) {
      Violated(seen.id, "has the turn of its tenant, and " + claimed->id + " is claimed");
    }
  }
  if (!waiting.empty()) ++counts_["claims while another tenant waits"];
  passed_.erase(served);
  for (auto place = passed_.begin(); place != passed_.end();) {
    place = waiting.count(place->first) == 0 ? passed_.erase(place) : std::next(place);
  }
  for (const std::string& tenant : waiting) {
    const int most = WeightOf(served) / WeightOf(tenant) + claimers_;
    if (++passed_[tenant][served] <= most) continue;
    Violated(claimed->id, "of " + served + " is claimed while " + tenant + " waits, the last of more than " +
                              std::to_string(most) + " claims");
  }
}

}  // namespace rollgait::server
