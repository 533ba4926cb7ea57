#include "server/service/warm_start_search.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "core/gait/default_speed.h"
#include "rollgait/v1/solve.pb.h"
#include "server/base/wire.pb.h"
#include "server/service/request_check.h"
#include "server/service/solve_key.h"
#include "server/service/solve_message.h"

namespace rollgait::server {
namespace {

constexpr double kSlopeUnit = std::numbers::pi / 180;  // rad
constexpr double kSpeedUnit = 0.05;                    // m/s
constexpr double kFarthest = 5;                        // in these units
constexpr int kMostConsidered = 1000;

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
  spec.clear_starts();
  spec.clear_warm_start();
  return CanonicalBytes(spec);
}

// The id of the nearest neighbour; empty: none.
Outcome<std::string> Nearest(SolveStore& store, const v1::SolveSpec& spec, const std::optional<std::string>& tenant) {
  const std::string common = CommonPart(spec);
  std::string nearest;
  double least = kFarthest;
  ListQuery query{200, "", SolveState::kSucceeded, tenant};
  for (int considered = 0; considered < kMostConsidered;) {
    const Outcome<SolvePage> page = store.List(query);
    if (!page.ok()) return page.error();
    for (const SolveRecord& record : page.value().records) {
      ++considered;
      v1::SolveSpec other;
      if (!other.ParseFromString(record.spec) || CommonPart(other) != common) continue;
      const std::optional<double> distance = WarmStartDistance(spec, other);
      if (!distance || *distance > least || (*distance == least && !nearest.empty())) continue;
      // Its record has no result; one that is not optimal is no neighbour.
      const Outcome<SolveRecord> full = store.Get(record.id);
      v1::SolveResult result;
      if (!full.ok() || !result.ParseFromString(full.value().result) || result.termination() != v1::TERMINATION_OPTIMAL)
        continue;
      least = *distance;
      nearest = record.id;
    }
    query.page_token = page.value().next_page_token;
    if (query.page_token.empty()) break;
  }
  return nearest;
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

std::optional<double> WarmStartDistance(const v1::SolveSpec& a, const v1::SolveSpec& b) {
  const std::optional<double> speed = PrescribedSpeed(a), other = PrescribedSpeed(b);
  if (speed.has_value() != other.has_value()) return std::nullopt;
  return std::hypot((a.slope_rad() - b.slope_rad()) / kSlopeUnit, speed ? (*speed - *other) / kSpeedUnit : 0);
}

Outcome<std::optional<FoundWarmStart>> FindWarmStart(SolveStore& store, const GaitKnowledge& knowledge,
                                                     const v1::SolveSpec& spec,
                                                     const std::optional<std::string>& tenant) {
  if (spec.warm_start().empty()) return std::optional<FoundWarmStart>();
  std::string id;
  if (spec.warm_start() == "nearest") {
    Outcome<std::string> nearest = Nearest(store, spec, tenant);
    if (!nearest.ok()) return nearest.error();
    id = std::move(nearest).value();
    if (id.empty()) return std::optional<FoundWarmStart>();
  } else {
    Outcome<std::string> named = SolveId(spec.warm_start());
    if (!named.ok()) return Refuse(spec, "give the name of a solve, solves/{id}, or nearest");
    id = std::move(named).value();
  }
  const Outcome<SolveRecord> record = store.Get(id);
  const bool foreign = record.ok() && tenant.value_or(record.value().tenant) != record.value().tenant;
  if (!record.ok() || foreign) {
    if (!foreign && record.error().code != ErrorCode::kNotFound) return record.error();
    return Refuse(spec, "there is no such solve; ListSolves lists those that are");
  }
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
