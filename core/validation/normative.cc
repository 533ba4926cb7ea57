#include "core/validation/normative.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

#include "core/base/check.h"
#include "core/validation/gait_cycle.h"

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kFiner = kCycleSteps / kNormativeSamples;  // our grid against that of the data
static_assert(kFiner * kNormativeSamples == kCycleSteps);
constexpr double kNearLimit = 0.5 * kDegree;
constexpr double kBodyWeight = 100;          // forces are in % of it
constexpr double kDepth = 5, kOnGround = 5;  // % of body weight

// Curves of one leg at 0 … 100 %, in the units and signs of NormativeQuantity.
class LegCurves {
 public:
  LegCurves(const Scene& scene, const GaitCycle& cycle, const GaitEvents& events, Foot leg)
      : scene_(scene), events_(events), leg_(leg) {
    for (int i = 0; i <= kCycleSteps; ++i) samples_.push_back(cycle.At(100.0 * i / kCycleSteps));
  }

  // Empty if the model lacks the joint, or a motor in it whose moment is asked for.
  std::vector<double> Of(NormativeQuantity quantity, const std::string& joint) const {
    switch (quantity) {
      case NormativeQuantity::kVerticalForce:
        return Force(2);
      case NormativeQuantity::kForwardForce:
        return Force(0);
      case NormativeQuantity::kAngle:
        return Angle(LegJoint(scene_.model, joint, SideOf(leg_)));
      case NormativeQuantity::kMoment:
        return Moment(LegJoint(scene_.model, joint, SideOf(leg_)));
    }
    ROLLGAIT_CHECK(false);
  }

 private:
  // Flexion and dorsiflexion are positive; moments of the data extend and plantarflex.
  std::vector<double> Angle(int joint) const {
    std::vector<double> values;
    if (joint < 0) return values;
    const double sign = scene_.model.FlexionSign(joint);
    for (const MotionSample& sample : samples_) values.push_back(sign * sample.position[joint] / kDegree);
    return values;
  }
  std::vector<double> Moment(int joint) const {
    const std::vector<int>& actuated = scene_.model.actuated();
    const auto place = std::find(actuated.begin(), actuated.end(), joint);
    std::vector<double> values;
    if (place == actuated.end()) return values;
    const auto effort = place - actuated.begin();
    const double sign = scene_.model.FlexionSign(joint);
    for (const MotionSample& sample : samples_) {
      values.push_back(-sign * sample.efforts[effort] / scene_.model.total_mass());
    }
    return values;
  }
  std::vector<double> Force(int axis) const {
    const auto row = events_.foot(leg_).level_force.row(axis) * (kBodyWeight / events_.body_weight);
    return {row.begin(), row.end()};
  }

  const Scene& scene_;
  const GaitEvents& events_;
  const Foot leg_;
  std::vector<MotionSample> samples_;
};

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

CurveComparison Compare(const NormativeCurve& normal, const std::vector<double>& fine) {
  CurveComparison result;
  result.quantity = normal.quantity;
  result.joint = normal.joint;
  for (int i = 0; i < kNormativeSamples; ++i) result.ours.push_back(fine[static_cast<size_t>(i) * kFiner]);
  result.mean = normal.mean;
  result.deviation = normal.deviation;
  result.distance = MeasureDistance(result.ours, normal.mean, normal.deviation);
  const auto [low, high] = std::minmax_element(fine.begin(), fine.end());
  const auto [normal_low, normal_high] = std::minmax_element(normal.mean.begin(), normal.mean.end());
  result.min = *low;
  result.max = *high;
  result.normative_min = *normal_low;
  result.normative_max = *normal_high;
  return result;
}

// Share of the cycle, from 0 %, until the force on the foot falls to kOnGround.
double StanceOf(const std::vector<double>& force) {
  size_t i = force.size() / 4;  // mid-stance
  while (i + 1 < force.size() && force[i + 1] > kOnGround) ++i;
  if (i + 1 == force.size()) return 1;
  const double part = (force[i] - kOnGround) / (force[i] - force[i + 1]);
  return (static_cast<double>(i) + part) / static_cast<double>(force.size());
}

DatasetComparison CompareWith(const NormativeDataset& set, const LegCurves& curves) {
  DatasetComparison result{set.name, set.source, set.deviation, set.speed, set.stride_time, 0, {}, {}};
  for (const NormativeCurve& normal : set.curves) {
    const std::vector<double> fine = curves.Of(normal.quantity, normal.joint);
    if (!fine.empty()) result.curves.push_back(Compare(normal, fine));
    if (normal.quantity != NormativeQuantity::kVerticalForce) continue;
    result.stance = StanceOf(normal.mean);
    const auto stance = static_cast<std::ptrdiff_t>(std::ceil(result.stance * kNormativeSamples));
    result.peaks = FindForcePeaks({normal.mean.begin(), normal.mean.begin() + stance}, kDepth);
  }
  return result;
}

std::vector<RestingJoint> FindResting(const Scene& scene, const GaitCycle& cycle, double stance, Foot leg) {
  constexpr int kSteps = 200;
  std::vector<RestingJoint> resting;
  std::vector<VectorX> positions;
  for (int i = 0; i <= kSteps; ++i) {
    const MotionSample sample = cycle.At(100.0 * stance * i / kSteps);
    positions.push_back(sample.position);
  }
  for (const int j : scene.model.actuated()) {
    const Joint& joint = scene.model.joint(j);
    if (joint.side != BodySide::kMidline && joint.side != SideOf(leg)) continue;
    const double count = static_cast<double>(positions.size());
    const auto share = [&](auto rests) { return std::count_if(positions.begin(), positions.end(), rests) / count; };
    const double low = share([&](const VectorX& q) { return q[j] <= joint.position_min + kNearLimit; });
    const double high = share([&](const VectorX& q) { return q[j] >= joint.position_max - kNearLimit; });
    if (low > 0) resting.push_back({joint.name, false, low});
    if (high > 0) resting.push_back({joint.name, true, high});
  }
  std::stable_sort(resting.begin(), resting.end(),
                   [](const RestingJoint& a, const RestingJoint& b) { return a.share > b.share; });
  return resting;
}

std::vector<double> StanceForce(const LegCurves& curves, double stance) {
  const std::vector<double> force = curves.Of(NormativeQuantity::kVerticalForce, "foot");
  const auto samples = static_cast<std::ptrdiff_t>(std::floor(stance * static_cast<double>(force.size() - 1))) + 1;
  return {force.begin(), force.begin() + std::min<std::ptrdiff_t>(samples, std::ssize(force))};
}

}  // namespace

int LegJoint(const Model& model, const std::string& name, BodySide side) {
  constexpr std::pair<const char*, JointRole> kRoles[] = {
      {"hip", JointRole::kHipFlexion}, {"knee", JointRole::kKneeFlexion}, {"ankle", JointRole::kAnkleDorsiflexion}};
  for (const auto& [joint, role] : kRoles) {
    if (name == joint) return model.Find(role, side);
  }
  return -1;
}

CurveDistance MeasureDistance(const std::vector<double>& ours, const std::vector<double>& mean,
                              const std::vector<double>& deviation) {
  ROLLGAIT_CHECK(ours.size() >= 2 && ours.size() == mean.size() && ours.size() == deviation.size());
  const double center = Mean(ours), normal_center = Mean(mean);
  double difference = 0, variance = 0, square = 0, normal_square = 0, product = 0;
  for (size_t i = 0; i < ours.size(); ++i) {
    const double a = ours[i] - center, b = mean[i] - normal_center;
    difference += (ours[i] - mean[i]) * (ours[i] - mean[i]);
    variance += deviation[i] * deviation[i];
    square += a * a;
    normal_square += b * b;
    product += a * b;
  }
  const double n = static_cast<double>(ours.size()), scale = std::sqrt(square) * std::sqrt(normal_square);
  return {std::sqrt(difference / n), variance > 0 ? std::sqrt(difference / variance) : kInfinity,
          scale > 0 ? product / scale : 0};
}

ForcePeaks FindForcePeaks(const std::vector<double>& force, double depth) {
  ForcePeaks peaks;
  if (force.size() < 5) return peaks;
  const auto middle = force.begin() + static_cast<std::ptrdiff_t>(force.size() / 2);
  const auto first = std::max_element(force.begin(), middle), second = std::max_element(middle, force.end());
  if (first != force.begin() && first != middle - 1) peaks.first = *first;
  if (second != middle && second != force.end() - 1) peaks.second = *second;
  if (!peaks.first || !peaks.second) return peaks;
  peaks.valley = *std::min_element(first, second);
  peaks.two = *peaks.valley <= std::min(*peaks.first, *peaks.second) - depth;
  return peaks;
}

NormativeComparison CompareWithPeople(const Scene& scene, const Trajectory& trajectory, const GaitEvents& events,
                                      Foot leg) {
  const auto cycle = GaitCycle::Of(scene, trajectory, SideOf(leg));
  const Foot other = leg == Foot::kRight ? Foot::kLeft : Foot::kRight;
  ROLLGAIT_CHECK(cycle.has_value());
  const LegCurves curves(scene, *cycle, events, leg);
  NormativeComparison result;
  result.stride_time = events.duration;
  result.speed = events.displacement / events.duration;
  result.step_length = events.displacement / 2;
  result.cadence = 2 * 60 / events.duration;
  result.stance = events.foot(leg).stance;
  result.double_support = events.double_support;
  result.opposite_toe_off = events.First(GaitEventKind::kToeOff, other);
  result.opposite_heel_strike = events.First(GaitEventKind::kHeelStrike, other);
  result.toe_off = events.First(GaitEventKind::kToeOff, leg);
  result.peaks = FindForcePeaks(StanceForce(curves, result.stance), kDepth);
  result.resting = FindResting(scene, *cycle, result.stance, leg);
  for (const NormativeDataset& set : NormativeDatasets()) result.datasets.push_back(CompareWith(set, curves));
  return result;
}

}  // namespace rollgait
