#include "server/service/warm_start_search.h"

#include <numbers>
#include <utility>
#include <vector>

#include "core/gait/default_speed.h"
#include "rollgait/v1/solve.pb.h"
#include "server/base/digest.h"
#include "server/base/wire.pb.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"
#include "server/service/solve_message.h"

namespace rollgait::server {
namespace {

constexpr double kSlopeUnit = std::numbers::pi / 180;  // rad
constexpr double kSpeedUnit = 0.05;                    // m/s
constexpr double kFarthest = 5;                        // in these units
constexpr int kPlacedAtOnce = 20;                      // their specs have up to 4 MiB each

Error Refuse(const v1::SolveSpec& spec, const std::string& reason) {
  return InvalidArgument({{"spec.warm_start", "is \"" + spec.warm_start() + "\"; " + reason}});
}

std::optional<double> PrescribedSpeed(const v1::SolveSpec& spec) {
  const v1::Motion& motion = spec.motion();
  if (motion.free_speed()) return std::nullopt;
  if (motion.has_speed_m_s()) return motion.speed_m_s();
  if (motion.has_step_length_m() && motion.has_step_duration_s())
    return motion.step_length_m() / motion.step_duration_s();
  return DefaultSpeed(spec.has_gravity_m_s2() ? spec.gravity_m_s2() : kDefaultGravity);
}

// What two requests must have in common to be neighbours.
std::string CommonPart(v1::SolveSpec spec) {
  spec.clear_slope_rad();
  spec.clear_motion();
  spec.mutable_discretization()->clear_single_support_intervals();
  spec.mutable_discretization()->clear_double_support_intervals();
  for (v1::Phase& phase : *spec.mutable_phases()->mutable_phases()) phase.clear_intervals();
  spec.clear_accuracy();
  spec.clear_solver_limits();
  spec.clear_nlp_solver();
  spec.clear_starts();
  spec.clear_warm_start();
  return CanonicalBytes(spec);
}

// The part of the message that the solver needs.
wire::WarmStart Take(const v1::SolveSpec& spec, const std::string& id, const v1::SolveSpec& source,
                     v1::SolveResult result) {
  wire::WarmStart start;
  start.mutable_source()->set_name(SolveName(id));
  start.mutable_source()->set_slope_difference_rad(spec.slope_rad() - source.slope_rad());
  if (const auto speed = PrescribedSpeed(spec)) {
    start.mutable_source()->set_speed_difference_m_s(*speed - result.speed_m_s());
  }
  *start.mutable_trajectory() = std::move(*result.mutable_trajectory());
  *start.mutable_multipliers() = std::move(*result.mutable_multipliers());
  return start;
}

}  // namespace

SolvePlace PlaceOf(const v1::SolveSpec& spec) {
  const std::optional<double> speed = PrescribedSpeed(spec);
  const char* const kind = speed ? "at a speed " : "at any speed ";
  return {Sha256Hex(kind + CommonPart(spec)), spec.slope_rad(), speed.value_or(0)};
}

Outcome<int> PlaceOldSolves(SolveStore& store) {
  int count = 0;
  int64_t last = 0;
  while (true) {
    const Outcome<std::vector<UnplacedSolve>> solves = store.Unplaced(last, kPlacedAtOnce);
    if (!solves.ok()) return solves.error();
    if (solves.value().empty()) return count;
    std::vector<PlacedSolve> placed;
    for (const UnplacedSolve& solve : solves.value()) {
      v1::SolveSpec spec;  // one that cannot be read stands nowhere
      placed.push_back({solve.number, spec.ParseFromString(solve.spec) ? PlaceOf(spec) : SolvePlace{}});
    }
    const Outcome<Done> set = store.SetPlaces(placed);
    if (!set.ok()) return set.error();
    last = placed.back().number;
    count += static_cast<int>(placed.size());
  }
}

Outcome<std::optional<FoundWarmStart>> FindWarmStart(SolveStore& store, const GaitKnowledge& knowledge,
                                                     const v1::SolveSpec& spec,
                                                     const std::optional<std::string>& tenant) {
  if (spec.warm_start().empty()) return std::optional<FoundWarmStart>();
  std::string id;
  if (spec.warm_start() == "nearest") {
    Outcome<std::string> nearest = store.Nearest({PlaceOf(spec), tenant, kSlopeUnit, kSpeedUnit, kFarthest});
    if (!nearest.ok()) return nearest.error();
    id = std::move(nearest).value();
    if (id.empty()) return std::optional<FoundWarmStart>();
  } else {
    Outcome<std::string> named = SolveId(spec.warm_start());
    if (!named.ok()) return Refuse(spec, "give the name of a solve, solves/{id}, or nearest");
    id = std::move(named).value();
  }
  const Outcome<SolveExtent> extent = store.Extent(id);
  const bool foreign = extent.ok() && tenant.value_or(extent.value().tenant) != extent.value().tenant;
  if (foreign || (!extent.ok() && extent.error().code == ErrorCode::kNotFound)) {
    return Refuse(spec, "there is no such solve; ListSolves lists those that are");
  }
  if (!extent.ok()) return extent.error();
  const Outcome<SolveRecord> record = store.Get(id);
  if (!record.ok()) return record.error();
  if (record.value().state != SolveState::kSucceeded) return Refuse(spec, "that solve has no result; wait for its end");
  v1::SolveSpec source;
  v1::SolveResult result;
  if (!source.ParseFromString(record.value().spec) || !result.ParseFromString(record.value().result)) {
    return Error{ErrorCode::kInternal, "the stored solve " + SolveName(id) + " cannot be read"};
  }
  if (result.termination() != v1::TERMINATION_OPTIMAL) {
    return Refuse(
        spec, "that solve ended " + v1::Termination_Name(result.termination()) + "; it must be TERMINATION_OPTIMAL");
  }
  const Violations violations = knowledge.check_warm_start(spec, result);
  if (!violations.empty()) return Refuse(spec, violations.front().message);
  const std::string& key = record.value().solve_key;
  return std::optional(
      FoundWarmStart{Take(spec, id, source, std::move(result)).SerializeAsString(), key.empty() ? id : key});
}

}  // namespace rollgait::server
