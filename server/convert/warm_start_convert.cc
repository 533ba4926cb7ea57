#include "server/convert/warm_start_convert.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/convert/scheme_convert.h"

namespace rollgait::server {
namespace {

Violations Refuse(const std::string& reason) { return {{"warm_start", "its solution " + reason}}; }

// Rows are times in the message, columns here. False if the message has not rows × columns finite values of these
// numbers.
bool DecodeTimes(const v1::Matrix& matrix, size_t rows, size_t columns, MatrixX* decoded) {
  if (matrix.rows() != static_cast<int64_t>(rows) || matrix.columns() != static_cast<int64_t>(columns) ||
      static_cast<size_t>(matrix.values_size()) != rows * columns) {
    return false;
  }
  *decoded = Eigen::Map<const MatrixX>(matrix.values().data(), static_cast<int>(columns), static_cast<int>(rows));
  return decoded->allFinite();
}

bool Ascends(const std::vector<double>& times) {
  if (times.size() < 2) return false;
  for (size_t k = 1; k < times.size(); ++k) {
    if (!(times[k] > times[k - 1]) || !std::isfinite(times[k])) return false;
  }
  return std::isfinite(times.front());
}

// False if sizes or numbers make no sense.
bool DecodePhase(const v1::TrajectoryPhase& phase, size_t joints, size_t actuated, int points, const Scene& scene,
                 TrajectoryPhase* decoded) {
  for (const std::string& name : phase.contacts()) {
    const auto contact = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                                      [&name](const ContactSurface& surface) { return surface.name == name; });
    if (contact == scene.contacts.end()) return false;
    decoded->contacts.push_back(static_cast<int>(contact - scene.contacts.begin()));
  }
  decoded->start = phase.start_s();
  decoded->duration = phase.duration_s();
  decoded->node_times.assign(phase.node_times_s().begin(), phase.node_times_s().end());
  decoded->point_times.assign(phase.point_times_s().begin(), phase.point_times_s().end());
  const size_t nodes = decoded->node_times.size(), count = decoded->point_times.size();
  if (!phase.impulses_n_s().empty()) {
    if (static_cast<size_t>(phase.impulses_n_s_size()) != 3 * decoded->contacts.size()) return false;
    decoded->impulses = Eigen::Map<const VectorX>(phase.impulses_n_s().data(), phase.impulses_n_s_size());
    if (!decoded->impulses.allFinite()) return false;
  }
  decoded->impact_loss = phase.impact_loss_j();
  if (!Ascends(decoded->node_times) || !(decoded->duration > 0) || count != (nodes - 1) * static_cast<size_t>(points)) {
    return false;
  }
  return DecodeTimes(phase.node_positions(), nodes, joints, &decoded->node_positions) &&
         DecodeTimes(phase.node_velocities(), nodes, joints, &decoded->node_velocities) &&
         DecodeTimes(phase.point_positions(), count, joints, &decoded->point_positions) &&
         DecodeTimes(phase.point_velocities(), count, joints, &decoded->point_velocities) &&
         DecodeTimes(phase.point_accelerations(), count, joints, &decoded->point_accelerations) &&
         DecodeTimes(phase.point_efforts(), count, actuated, &decoded->point_efforts) &&
         DecodeTimes(phase.point_forces(), count, 3 * decoded->contacts.size(), &decoded->point_forces);
}

// Where the collocation points of an interval are: from those of the first one.
std::vector<double> PointFractions(const TrajectoryPhase& phase, int points) {
  std::vector<double> fractions;
  const double start = phase.node_times[0], length = phase.node_times[1] - start;
  for (int i = 0; i < points; ++i) fractions.push_back((phase.point_times[i] - start) / length);
  return fractions;
}

std::optional<SolutionMultipliers> DecodeMultipliers(const v1::Multipliers& multipliers) {
  if (multipliers.rows().empty()) return std::nullopt;
  SolutionMultipliers decoded;
  decoded.rows = Eigen::Map<const Eigen::VectorXf>(multipliers.rows().data(), multipliers.rows_size()).cast<double>();
  decoded.bounds =
      Eigen::Map<const Eigen::VectorXf>(multipliers.bounds().data(), multipliers.bounds_size()).cast<double>();
  if (!decoded.rows.allFinite() || !decoded.bounds.allFinite()) return std::nullopt;
  return decoded;
}

// Ascending indices below `count`; empty if they are none.
std::optional<std::vector<int>> DecodeIndices(const google::protobuf::RepeatedField<int32_t>& indices, size_t count) {
  std::vector<int> decoded(indices.begin(), indices.end());
  const bool ascending = std::is_sorted(decoded.begin(), decoded.end(), std::less_equal<int>());
  if (!ascending || (!decoded.empty() && (decoded.front() < 0 || decoded.back() >= static_cast<int>(count))))
    return std::nullopt;
  return decoded;
}

// Ascending edges of contacts below `count`; empty if they are none.
std::optional<std::vector<FrictionEdge>> DecodeEdges(
    const google::protobuf::RepeatedPtrField<v1::Multipliers::FrictionEdge>& edges, size_t count) {
  std::vector<FrictionEdge> decoded;
  for (const v1::Multipliers::FrictionEdge& edge : edges) {
    if (edge.contact() < 0 || edge.contact() >= static_cast<int>(count) || edge.direction() < 0 ||
        edge.direction() >= FrictionEdge::kDirections) {
      return std::nullopt;
    }
    decoded.push_back({edge.contact(), edge.direction()});
  }
  if (!std::is_sorted(decoded.begin(), decoded.end(), std::less_equal<FrictionEdge>())) return std::nullopt;
  return decoded;
}

// The constraints of the program that the multipliers are of; empty if they are none of this scene.
std::optional<AddedConstraints> DecodeAdded(const v1::Multipliers& multipliers, const Scene& scene, size_t phases) {
  const size_t joints = static_cast<size_t>(scene.model.size());
  AddedConstraints added;
  if (static_cast<size_t>(multipliers.between_size()) > phases) return std::nullopt;
  for (const v1::Multipliers::BoundedBetween& phase : multipliers.between()) {
    const auto range = DecodeIndices(phase.range(), joints), velocity = DecodeIndices(phase.velocity(), joints),
               effort = DecodeIndices(phase.effort(), joints);
    const auto friction = DecodeEdges(phase.friction(), scene.contacts.size());
    if (!range || !velocity || !effort || !friction) return std::nullopt;
    added.between.push_back({*range, *velocity, *effort, *friction});
  }
  const auto separated = DecodeIndices(multipliers.separated(), scene.pairs.size());
  if (!separated) return std::nullopt;
  added.separated = *separated;
  return added;
}

}  // namespace

Result<WarmStart> DecodeWarmStart(const v1::Trajectory& trajectory, const v1::Multipliers& multipliers,
                                  const GaitSpec& spec) {
  const Model& model = spec.scene.model;
  std::vector<std::string> joints;
  for (const Joint& joint : model.joints()) joints.push_back(joint.name);
  if (!std::equal(joints.begin(), joints.end(), trajectory.joint_names().begin(), trajectory.joint_names().end())) {
    return Refuse("has other joints than the model of this request; name a solve of the same model, reduced alike");
  }
  const std::optional<Scheme> scheme = DecodeScheme(trajectory.scheme());
  const int points = trajectory.points_per_interval();
  if (!scheme || points < 1 || points > 8) return Refuse("has a scheme that this server does not know");
  WarmStart start;
  start.trajectory.scheme = *scheme;
  start.trajectory.points_per_interval = points;
  start.trajectory.cycle = trajectory.cycle() == v1::CYCLE_FULL   ? Cycle::kFull
                           : trajectory.cycle() == v1::CYCLE_HALF ? Cycle::kHalf
                                                                  : Cycle::kOnce;
  start.trajectory.duration = trajectory.duration_s();
  start.trajectory.displacement = trajectory.displacement_m();
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    if (!DecodePhase(phase, joints.size(), model.actuated().size(), points, spec.scene,
                     &start.trajectory.phases.emplace_back())) {
      return Refuse("has a phase whose contacts or sizes are not those of the model of this request");
    }
  }
  Violations violations = CheckWarmStart(spec, start.trajectory);
  if (!violations.empty()) return violations;
  start.trajectory.point_fractions = PointFractions(start.trajectory.phases.front(), points);
  const std::optional<AddedConstraints> added = DecodeAdded(multipliers, spec.scene, start.trajectory.phases.size());
  if (added) {
    start.added = *added;
    start.multipliers = DecodeMultipliers(multipliers);
  }
  return start;
}

}  // namespace rollgait::server
