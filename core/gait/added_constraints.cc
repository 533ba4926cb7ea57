#include "core/gait/added_constraints.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

constexpr int kSamples = 16;  // an interval; what they miss of the largest excess, the finding names
// Of the bound: a joint so close to it would violate it on the next mesh.
constexpr double kNear = 0.5;
constexpr double kFlatSideShare = 1e-3;  // of the objective

template <typename T>
bool Insert(const T& value, std::vector<T>* values) {
  const auto place = std::lower_bound(values->begin(), values->end(), value);
  if (place != values->end() && *place == value) return false;
  values->insert(place, value);
  return true;
}

double ExcessOf(double value, double min, double max) { return std::max({0.0, min - value, value - max}); }

// Joints of one phase past their limits, in the measures of the criteria.
class PhaseExcesses {
 public:
  PhaseExcesses(const GaitSpec& spec, BoundedBetween* between) : spec_(spec), between_(between) {}

  void Add(const MotionSample& sample) {
    const Model& model = spec_.scene.model;
    for (int j = 0; j < model.size(); ++j) {
      const Joint& joint = model.joint(j);
      Judge(Criterion::kJointRange, ExcessOf(sample.position[j], joint.position_min, joint.position_max), j);
      Judge(Criterion::kJointVelocity,
            ExcessOf(sample.velocity[j], -joint.velocity_max, joint.velocity_max) / joint.velocity_max, j);
    }
    for (size_t a = 0; a < model.actuated().size(); ++a) {
      const Joint& joint = model.joint(model.actuated()[a]);
      const double strength = std::max(-joint.effort_min, joint.effort_max);
      Judge(Criterion::kJointEffort,
            ExcessOf(sample.efforts[static_cast<int>(a)], joint.effort_min, joint.effort_max) / strength,
            model.actuated()[a]);
    }
  }
  bool any() const { return any_; }

 private:
  void Judge(Criterion criterion, double excess, int joint) {
    if (!(excess > kNear * spec_.bounds[criterion])) return;
    std::vector<int>* joints = criterion == Criterion::kJointRange      ? &between_->range
                               : criterion == Criterion::kJointVelocity ? &between_->velocity
                                                                        : &between_->effort;
    any_ |= Insert(joint, joints);
  }
  const GaitSpec& spec_;
  BoundedBetween* between_;
  bool any_ = false;
};

}  // namespace

AddedConstraints UsualConstraints(const GaitSpec& spec) {
  AddedConstraints added;
  if (spec.bounds[Criterion::kOverlap] == kInfinity) return added;
  for (size_t pair = 0; pair < spec.scene.pairs.size(); ++pair) {
    if (spec.scene.pairs[pair].usual) added.separated.push_back(static_cast<int>(pair));
  }
  return added;
}

bool AddOverlapping(const GaitSpec& spec, const AccuracyReport& report, AddedConstraints* added) {
  if (spec.bounds[Criterion::kOverlap] == kInfinity) return false;
  const size_t before = added->separated.size();
  KeepApart(report.overlapping_pairs, added);
  return added->separated.size() > before;
}

void KeepApart(const std::vector<int>& pairs, AddedConstraints* added) {
  for (int pair : pairs) Insert(pair, &added->separated);
}

double LeastCostOfASide(const GaitSpec& spec, double objective, double typical) {
  return std::max(kFlatSideShare * std::abs(objective), spec.kkt_tolerance * typical);
}

bool AddFrictionEdges(const std::vector<FlatSide>& sides, double least_cost, AddedConstraints* added) {
  bool any = false;
  for (const FlatSide& flat : sides) {
    if (!(flat.cost > least_cost)) continue;
    const double step = 2 * std::numbers::pi / FrictionEdge::kDirections;
    const int direction = static_cast<int>(std::lround(flat.direction / step));
    if (direction <= flat.side.from || direction >= flat.side.to) continue;
    const size_t phase = static_cast<size_t>(flat.phase);
    if (added->between.size() <= phase) added->between.resize(phase + 1);
    any |= Insert(FrictionEdge{flat.contact, direction}, &added->between[phase].friction);
  }
  return any;
}

bool AddViolated(const GaitSpec& spec, const Trajectory& trajectory, const AccuracyReport& report,
                 AddedConstraints* added) {
  added->between.resize(trajectory.phases.size());
  bool any = false;
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    PhaseExcesses excesses(spec, &added->between[p]);
    MotionSample sample;
    for (size_t k = 0; k + 1 < trajectory.phases[p].node_times.size(); ++k) {
      const IntervalPolynomials interval(trajectory, static_cast<int>(p), static_cast<int>(k));
      for (int i = 0; i <= kSamples; ++i) {
        interval.Evaluate(static_cast<double>(i) / kSamples, &sample);
        excesses.Add(sample);
      }
    }
    any |= excesses.any();
  }
  const auto add_finding = [&](Criterion criterion, std::vector<int> BoundedBetween::*joints) {
    const Finding& finding = report.findings[static_cast<int>(criterion)];
    const int joint = spec.scene.model.Find(finding.where);
    if (finding.value > spec.bounds[criterion] && joint >= 0) {
      any |= Insert(joint, &(added->between[static_cast<size_t>(finding.phase)].*joints));
    }
  };
  add_finding(Criterion::kJointRange, &BoundedBetween::range);
  add_finding(Criterion::kJointVelocity, &BoundedBetween::velocity);
  add_finding(Criterion::kJointEffort, &BoundedBetween::effort);
  return any;
}

}  // namespace rollgait
