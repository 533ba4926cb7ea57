#include "core/validation/motion_difference.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/check.h"
#include "core/trajectory/sampling.h"

namespace rollgait {
namespace {

// Gauss-Legendre points and weights on [0, 1].
constexpr std::array<double, 4> kPoints = {0.069431844202973713, 0.33000947820757187, 0.66999052179242813,
                                           0.93056815579702629};
constexpr std::array<double, 4> kWeights = {0.17392742256872692, 0.32607257743127307, 0.32607257743127307,
                                            0.17392742256872692};

// Nodes as fractions of the phase, from 0 to 1.
std::vector<double> Fractions(const TrajectoryPhase& phase) {
  std::vector<double> fractions;
  const double start = phase.node_times.front(), length = phase.node_times.back() - start;
  for (const double time : phase.node_times) fractions.push_back((time - start) / length);
  return fractions;
}

std::vector<double> Merged(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr double kRounding = 1e-9;  // of times that are the same instant
  std::vector<double> all(a);
  all.insert(all.end(), b.begin(), b.end());
  std::sort(all.begin(), all.end());
  std::vector<double> merged;
  for (const double fraction : all) {
    if (merged.empty() || fraction - merged.back() > kRounding) merged.push_back(fraction);
  }
  return merged;
}

// A phase that is read at rising fractions.
class PhaseReader {
 public:
  PhaseReader(const Trajectory& trajectory, int phase)
      : trajectory_(trajectory), phase_(phase), fractions_(Fractions(trajectory.phases[phase])) {}

  const MotionSample& At(double fraction) {
    const int last = static_cast<int>(fractions_.size()) - 2;
    int interval = interval_;
    while (interval < last && fraction > fractions_[interval + 1]) ++interval;
    if (interval != interval_ || !polynomials_) {
      interval_ = interval;
      polynomials_.emplace(trajectory_, phase_, interval_);
    }
    const double from = fractions_[interval_], to = fractions_[interval_ + 1];
    polynomials_->Evaluate(std::clamp((fraction - from) / (to - from), 0.0, 1.0), &sample_);
    return sample_;
  }

 private:
  const Trajectory& trajectory_;
  int phase_;
  std::vector<double> fractions_;
  int interval_ = 0;
  std::optional<IntervalPolynomials> polynomials_;
  MotionSample sample_;
};

// One joint or contact of a quantity.
struct Channel {
  MotionQuantity quantity;
  std::string name;
  double squares = 0;          // integral of the squared difference, by time
  double peak = 0, other = 0;  // largest absolute values
};

class Comparison {
 public:
  explicit Comparison(const Scene& scene) {
    const Model& model = scene.model;
    for (int joint = 0; joint < model.size(); ++joint) {
      const bool slides = model.joint(joint).kind().is_slide();
      positions_.push_back(Add(slides ? MotionQuantity::kPlace : MotionQuantity::kAngle, model.joint(joint).name));
      velocities_.push_back(
          Add(slides ? MotionQuantity::kLinearVelocity : MotionQuantity::kAngularVelocity, model.joint(joint).name));
    }
    for (const int joint : model.actuated()) {
      const bool slides = model.joint(joint).kind().is_slide();
      efforts_.push_back(Add(slides ? MotionQuantity::kForce : MotionQuantity::kTorque, model.joint(joint).name));
    }
    for (const ContactSurface& contact : scene.contacts) {
      contacts_.push_back(Add(MotionQuantity::kContactForce, contact.name));
    }
  }

  void Take(int phase, const std::vector<int>& contacts, double time, double weight, const MotionSample& a,
            const MotionSample& b) {
    phase_ = phase;
    time_ = time;
    weight_ = weight;
    for (size_t j = 0; j < positions_.size(); ++j) Take(positions_[j], a.position(j), b.position(j));
    for (size_t j = 0; j < velocities_.size(); ++j) Take(velocities_[j], a.velocity(j), b.velocity(j));
    for (size_t j = 0; j < efforts_.size(); ++j) Take(efforts_[j], a.efforts(j), b.efforts(j));
    for (size_t c = 0; c < contacts.size(); ++c) {
      const Vector3 one = a.forces.segment<3>(3 * c), two = b.forces.segment<3>(3 * c);
      Take(contacts_[contacts[c]], (one - two).norm(), one.norm(), two.norm());
    }
  }

  MotionDifference Finish(double duration) {
    for (const Channel& channel : channels_) {
      QuantityDifference& difference = At(channel.quantity);
      difference.rms = std::max(difference.rms, std::sqrt(channel.squares / duration));
      difference.peak = std::max(difference.peak, std::abs(channel.peak - channel.other));
    }
    return difference_;
  }

 private:
  int Add(MotionQuantity quantity, const std::string& name) {
    channels_.push_back({quantity, name});
    return static_cast<int>(channels_.size()) - 1;
  }
  QuantityDifference& At(MotionQuantity quantity) { return difference_[static_cast<int>(quantity)]; }
  void Take(int channel, double a, double b) { Take(channel, std::abs(a - b), std::abs(a), std::abs(b)); }
  void Take(int number, double apart, double a, double b) {
    Channel& channel = channels_[number];
    channel.squares += weight_ * apart * apart;
    channel.peak = std::max(channel.peak, a);
    channel.other = std::max(channel.other, b);
    QuantityDifference& difference = At(channel.quantity);
    if (!(apart > difference.largest)) return;
    difference.largest = apart;
    difference.where = channel.name;
    difference.phase = phase_;
    difference.time = time_;
  }

  std::vector<Channel> channels_;
  std::vector<int> positions_, velocities_, efforts_, contacts_;  // numbers of channels
  MotionDifference difference_;
  int phase_ = 0;
  double time_ = 0, weight_ = 0;
};

}  // namespace

const std::array<MotionQuantityTraits, kMotionQuantityCount>& MotionQuantities() {
  static const std::array<MotionQuantityTraits, kMotionQuantityCount> table = {{
      {MotionQuantity::kAngle, "joint angle", "rad"},
      {MotionQuantity::kPlace, "place", "m"},
      {MotionQuantity::kAngularVelocity, "angular velocity", "rad/s"},
      {MotionQuantity::kLinearVelocity, "velocity", "m/s"},
      {MotionQuantity::kTorque, "joint torque", "N m"},
      {MotionQuantity::kForce, "joint force", "N"},
      {MotionQuantity::kContactForce, "contact force", "N"},
  }};
  return table;
}

MotionDifference CompareMotions(const Scene& scene, const Trajectory& trajectory, const Trajectory& other) {
  ROLLGAIT_CHECK(trajectory.phases.size() == other.phases.size());
  Comparison comparison(scene);
  for (size_t p = 0; p < trajectory.phases.size(); ++p) {
    const TrajectoryPhase& phase = trajectory.phases[p];
    ROLLGAIT_CHECK(phase.contacts == other.phases[p].contacts);
    const int number = static_cast<int>(p);
    PhaseReader one(trajectory, number), two(other, number);
    const std::vector<double> cuts = Merged(Fractions(phase), Fractions(other.phases[p]));
    for (size_t c = 0; c + 1 < cuts.size(); ++c) {
      const double length = cuts[c + 1] - cuts[c];
      for (size_t i = 0; i < kPoints.size(); ++i) {
        const double fraction = cuts[c] + kPoints[i] * length;
        comparison.Take(number, phase.contacts, phase.start + fraction * phase.duration,
                        kWeights[i] * length * phase.duration, one.At(fraction), two.At(fraction));
      }
    }
  }
  return comparison.Finish(trajectory.duration);
}

}  // namespace rollgait
