#include "core/gait/initial_guess.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace rollgait {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Flexion of hip, knee and dorsiflexion of the ankle, degrees, hand-set, against the fraction of the leg's own cycle:
// stance from 0 (touch-down) to 0.6 (lift-off), swing from 0.6 to 1.
struct LegPose {
  double fraction, hip, knee, ankle;
};
constexpr std::array<LegPose, 8> kLegCycle = {{{0.0, 24, 6, 0},
                                               {0.1, 20, 14, -3},
                                               {0.3, 4, 9, 5},
                                               {0.5, -13, 9, 9},
                                               {0.6, -5, 36, -10},
                                               {0.75, 20, 60, 0},
                                               {0.9, 27, 22, 2},
                                               {1.0, 24, 6, 0}}};
constexpr double kLiftOff = 0.6;

// Periodic cubic Hermite interpolation with slopes of neighbouring knots' differences.
double LegAngle(double fraction, double LegPose::*angle) {
  fraction -= std::floor(fraction);
  const int last = static_cast<int>(kLegCycle.size()) - 1;
  int k = 0;
  while (k < last - 1 && fraction >= kLegCycle[k + 1].fraction) ++k;
  const auto slope = [&](int i) {
    const int before = i == 0 ? last - 1 : i - 1, after = i == last ? 1 : i + 1;
    const double left = i == 0 ? kLegCycle[last].fraction - kLegCycle[last - 1].fraction
                               : kLegCycle[i].fraction - kLegCycle[i - 1].fraction;
    const double right = i == last ? kLegCycle[1].fraction : kLegCycle[i + 1].fraction - kLegCycle[i].fraction;
    return (kLegCycle[after].*angle - kLegCycle[before].*angle) / (left + right);
  };
  const double h = kLegCycle[k + 1].fraction - kLegCycle[k].fraction;
  const double t = (fraction - kLegCycle[k].fraction) / h;
  const double t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * kLegCycle[k].*angle + (t3 - 2 * t2 + t) * h * slope(k) +
         (3 * t2 - 2 * t3) * kLegCycle[k + 1].*angle + (t3 - t2) * h * slope(k + 1);
}

bool Contains(const std::vector<int>& values, int value) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

// The legs of a body: contacts on the same side are one leg; a contact on none is a leg of its own.
struct Legs {
  explicit Legs(const OptimalControlProblem& problem) {
    for (const ContactSurface& contact : problem.contacts) {
      const auto known = std::find(side.begin(), side.end(), contact.side);
      const bool is_new = contact.side == BodySide::kMidline || known == side.end();
      of_contact.push_back(static_cast<int>(is_new ? side.size() : known - side.begin()));
      if (is_new) side.push_back(contact.side);
    }
  }
  std::vector<int> of_contact;
  std::vector<BodySide> side;  // of each leg
};

// When each leg touches down and lifts off, in a full cycle of the phases.
class Footfalls {
 public:
  Footfalls(const OptimalControlProblem& problem, const Legs& legs, const std::vector<double>& durations) {
    struct Piece {
      std::vector<int> legs;  // that stand
      double start, end;
    };
    std::vector<Piece> pieces;
    for (int half = 0; half < (problem.mirrored ? 2 : 1); ++half) {
      for (size_t p = 0; p < problem.phases.size(); ++p) {
        Piece piece{{}, cycle_, cycle_ + durations[p]};
        for (int contact : problem.phases[p].active) {
          piece.legs.push_back(legs.of_contact[half == 1 ? problem.contacts[contact].mirror_contact : contact]);
        }
        pieces.push_back(piece);
        cycle_ = piece.end;
      }
    }
    const size_t count = pieces.size();
    touch_down_.assign(legs.side.size(), 0);
    stance_.assign(legs.side.size(), kLiftOff * cycle_);
    for (size_t l = 0; l < legs.side.size(); ++l) {
      const int leg = static_cast<int>(l);
      for (size_t i = 0; i < count; ++i) {
        if (!Contains(pieces[i].legs, leg) || Contains(pieces[(i + count - 1) % count].legs, leg)) continue;
        touch_down_[l] = pieces[i].start;
        double stance = 0;
        for (size_t j = i; j < i + count && Contains(pieces[j % count].legs, leg); ++j) {
          stance += pieces[j % count].end - pieces[j % count].start;
        }
        stance_[l] = stance;
      }
    }
  }

  // Fraction of the leg's own cycle at time t.
  double LegFraction(int leg, double t) const {
    double since = std::fmod(t - touch_down_[leg], cycle_);
    if (since < 0) since += cycle_;
    if (since < stance_[leg]) return kLiftOff * since / stance_[leg];
    return kLiftOff + (1 - kLiftOff) * (since - stance_[leg]) / (cycle_ - stance_[leg]);
  }

 private:
  double cycle_ = 0;
  std::vector<double> touch_down_, stance_;
};

// Arms swing against the leg of their side, elbows a little bent.
constexpr double kArmSwing = -0.6, kArmMean = 5 * kDegree, kElbow = 20 * kDegree;

// What a variant of the guess changes.
struct Style {
  double step = 1, hip = 1, knee = 1, ankle = 1;
  double lean = 0;  // rad

  explicit Style(int variant) {
    if (variant == 0) return;
    std::mt19937 generator(static_cast<std::mt19937::result_type>(variant));
    // In [-1, 1], the same with every standard library.
    const auto draw = [&generator] { return 2 * (static_cast<double>(generator()) / 4294967295.0) - 1; };
    for (double* factor : {&step, &hip, &knee, &ankle}) *factor += 0.25 * draw();
    lean = 10 * kDegree * draw();
  }
};

class Walk {
 public:
  Walk(const OptimalControlProblem& problem, std::vector<double> durations, double displacement, const Style& style)
      : problem_(problem),
        style_(style),
        legs_(problem),
        durations_(std::move(durations)),
        displacement_(displacement),
        footfalls_(problem, legs_, durations_) {
    for (double d : durations_) total_ += d;
  }

  VectorX Position(int phase, double fraction) const {
    double time = fraction * durations_[phase];
    for (int p = 0; p < phase; ++p) time += durations_[p];
    const Model& model = problem_.model;
    VectorX q = VectorX::Zero(model.size());
    for (size_t l = 0; l < legs_.side.size(); ++l) {
      const BodySide side = legs_.side[l];
      if (side == BodySide::kMidline) continue;
      const double leg = footfalls_.LegFraction(static_cast<int>(l), time);
      const double hip = style_.hip * LegAngle(leg, &LegPose::hip) * kDegree;
      if (Flex(JointRole::kHipFlexion, side, hip, &q)) SwingArm(side, hip, &q);
      Flex(JointRole::kKneeFlexion, side, style_.knee * LegAngle(leg, &LegPose::knee) * kDegree, &q);
      Flex(JointRole::kAnkleDorsiflexion, side, style_.ankle * LegAngle(leg, &LegPose::ankle) * kDegree, &q);
    }
    q(problem_.forward_joint) = displacement_ * time / total_;
    Flex(JointRole::kBasePitch, BodySide::kMidline, style_.lean, &q);
    LowerOntoGround(&q);
    return q;
  }

  MotionSample Sample(int phase, double fraction) const {
    const double step = 1e-3;
    MotionSample sample;
    sample.position = Position(phase, fraction);
    sample.velocity =
        (Position(phase, std::min(1.0, fraction + step)) - Position(phase, std::max(0.0, fraction - step))) /
        ((std::min(1.0, fraction + step) - std::max(0.0, fraction - step)) * durations_[phase]);
    sample.acceleration = VectorX::Zero(problem_.model.size());
    sample.efforts = VectorX::Zero(static_cast<int>(problem_.model.actuated().size()));
    const std::vector<int>& active = problem_.phases[phase].active;
    const std::vector<int> previous = problem_.PreviousActive(phase);
    sample.forces = VectorX::Zero(3 * static_cast<int>(active.size()));
    constexpr double kLeastShare = 0.2;  // away from the bound that every normal force has
    double sum = 0;
    std::vector<double> shares;
    for (int contact : active) {
      // Contacts that were there hand over to those that are new.
      const bool hands_over = active.size() > 1 && Contains(previous, contact);
      shares.push_back(active.size() == 1 ? 1 : kLeastShare + (hands_over ? 1 - fraction : fraction));
      sum += shares.back();
    }
    for (size_t c = 0; c < active.size(); ++c) {
      const double share = shares[c] / sum;
      sample.forces(3 * static_cast<int>(c) + 2) = share * problem_.force_size();
    }
    return sample;
  }

 private:
  // Flexes the joint with a role by an angle (rad). False if there is none.
  bool Flex(JointRole role, BodySide side, double angle, VectorX* q) const {
    const int joint = problem_.model.Find(role, side);
    if (joint < 0) return false;
    (*q)(joint) = problem_.model.FlexionSign(joint) * angle;
    return true;
  }

  // The arm on the side of a hip that is flexed by the given angle.
  void SwingArm(BodySide side, double angle, VectorX* q) const {
    Flex(JointRole::kShoulderFlexion, side, kArmSwing * (angle - kArmMean), q);
    Flex(JointRole::kElbowFlexion, side, kElbow, q);
  }

  // Moves the vertical base joint so that the lowest surfaces touch the ground: the soft minimum of all gaps is zero,
  // whatever the phase, so that the body's height has no step and no kink where contacts change.
  void LowerOntoGround(VectorX* q) const {
    constexpr double kSoftness = 0.005;  // m
    const int vertical = problem_.model.Find(JointRole::kBaseVertical);
    ROLLGAIT_CHECK(vertical >= 0);
    TreeDynamics tree(problem_.model);
    const VectorX zero = VectorX::Zero(problem_.model.size());
    tree.UpdateKinematics(q->data(), zero.data());
    std::vector<double> gaps;
    for (const ContactSurface& surface : problem_.contacts) {
      ContactDerivatives<double> contact(problem_.model, surface);
      contact.Update(tree);
      gaps.push_back(contact.point().z());
    }
    const double least = *std::min_element(gaps.begin(), gaps.end());
    double sum = 0;
    for (const double gap : gaps) sum += std::exp((least - gap) / kSoftness);
    (*q)(vertical) -= least - kSoftness * std::log(sum);
  }

  const OptimalControlProblem& problem_;
  Style style_;
  Legs legs_;
  std::vector<double> durations_;
  double displacement_;
  double total_ = 0;
  Footfalls footfalls_;
};

// Speed and step length of a comfortable walk within what is prescribed.
struct Travel {
  double duration, displacement;
};

Travel ChooseTravel(const GaitSpec& spec, const OptimalControlProblem& problem, double step_factor) {
  const double steps = problem.mirrored ? 1 : 2;
  const double leg = spec.scene.leg_length, comfortable = 1.3 * spec.similarity.speed();
  const double speed = spec.speed.value_or(std::clamp(comfortable, problem.speed.min, problem.speed.max));
  const double natural = step_factor * 0.72 * leg * std::sqrt(speed / comfortable);
  double step = spec.step_length.value_or(spec.step_duration ? speed * *spec.step_duration : natural);
  step = std::clamp(step, problem.displacement.min / steps, problem.displacement.max / steps);
  const double duration = spec.step_duration.value_or(step / speed);
  return {std::clamp(duration * steps, problem.duration.min, problem.duration.max), step * steps};
}

}  // namespace

MotionGuess WalkingGuess(const GaitSpec& spec, const OptimalControlProblem& problem, int variant) {
  const Style style(variant);
  const Travel travel = ChooseTravel(spec, problem, style.step);
  MotionGuess guess;
  guess.displacement = travel.displacement;
  // A phase on both legs takes a quarter of what a phase on one leg takes.
  const Legs legs(problem);
  const auto part = [&legs](const PhaseDescription& phase) {
    const int first = legs.of_contact[phase.active.front()];
    return std::all_of(phase.active.begin(), phase.active.end(), [&](int c) { return legs.of_contact[c] == first; })
               ? 4
               : 1;
  };
  double weight = 0;
  for (const PhaseDescription& phase : problem.phases) weight += part(phase);
  for (const PhaseDescription& phase : problem.phases) {
    const double share = part(phase) / weight;
    guess.durations.push_back(std::clamp(share * travel.duration, phase.duration.min, phase.duration.max));
  }
  const auto walk = std::make_shared<Walk>(problem, guess.durations, guess.displacement, style);
  guess.motion = [walk](int phase, double fraction) { return walk->Sample(phase, fraction); };
  return guess;
}

MotionGuess GuessFromTrajectory(const Trajectory& trajectory) {
  MotionGuess guess;
  guess.displacement = trajectory.displacement;
  guess.near_solution = true;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    guess.durations.push_back(phase.duration);
    guess.impulses.push_back(phase.impulses);
  }
  guess.motion = [trajectory](int phase, double fraction) {
    const std::vector<double>& nodes = trajectory.phases[phase].node_times;
    const double time = nodes.front() + fraction * (nodes.back() - nodes.front());
    const auto after = std::upper_bound(nodes.begin() + 1, nodes.end() - 1, time);
    const int interval = static_cast<int>(after - nodes.begin()) - 1;
    return Sample(trajectory, phase, interval, (time - nodes[interval]) / (nodes[interval + 1] - nodes[interval]));
  };
  return guess;
}

}  // namespace rollgait
