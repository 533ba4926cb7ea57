// A step of the five-link biped RABBIT (Kelly, SIAM Review 59, 2017): 0.5 m in 0.7 s on
// point feet, with torques at hips and knees, none at the stance foot and a plastic impact of the other foot, after
// which the next step starts as the mirror image; knees do not overextend; least ∫ Σ τ² dt. As in Kelly's program
// (OptimTraj, demo/fiveLinkBiped) the 0.2 m of the trunk are from its upper end. It is built as one of our walkers,
// with a floating base, rolling contacts (spheres of no size) and forces of the ground, and solved as the half cycle of
// a gait. The friction pyramid and forces that push are no part of Kelly's problem; they are not active here.
#include <cmath>
#include <string>

#include "core/ocp/costs/point_costs.h"
#include "tests/core/known_answers/known_problem.h"

namespace rollgait {
namespace {

constexpr double kSegment = 0.4;  // m, thigh and shank
constexpr double kStep = 0.5;     // m
constexpr double kTime = 0.7;     // s
constexpr double kGravity = 9.81;

// Angles are positive where a leg swings forward and the trunk leans backward.
Joint Link(const std::string& name, int parent, const Vector3& at, double mass, double center, double inertia) {
  Joint joint;
  joint.name = name;
  joint.link = name + "_link";
  joint.axis = -Vector3::UnitY();
  joint.parent = parent;
  joint.p_PJ = at;
  joint.mass = mass;
  joint.center_of_mass = Vector3(0, 0, center);
  joint.inertia = Vector3(inertia, inertia, 0).asDiagonal();
  return joint;
}

Model Rabbit() {
  std::vector<Joint> joints(2);
  for (Joint& base : joints) base.type = JointType::kPrismatic;
  joints[0].name = "base_x", joints[0].link = "carriage", joints[0].axis = Vector3::UnitX();
  joints[1].name = "base_z", joints[1].link = "hip", joints[1].axis = Vector3::UnitZ(), joints[1].parent = 0;
  joints.push_back(Link("trunk", 1, Vector3::Zero(), 20, 0.625 - 0.2, 2.22));
  for (const std::string side : {"r", "l"}) {
    const int hip = static_cast<int>(joints.size());
    joints.push_back(Link("hip_" + side, 2, Vector3::Zero(), 6.8, -0.163, 1.08));
    joints.push_back(Link("knee_" + side, hip, Vector3(0, 0, -kSegment), 3.2, -0.128, 0.93));
    joints.back().position_max = 0;
  }
  for (int j = 3; j < 7; ++j) {
    Joint& joint = joints[static_cast<size_t>(j)];
    joint.mirror_joint = j < 5 ? j + 2 : j - 2;
    joint.actuated = true;
    joint.effort_min = -kInfinity, joint.effort_max = kInfinity;
  }
  return Model::Create(joints).value();
}

ContactSurface Foot(const std::string& name, int joint, int mirror) {
  ContactSurface foot;
  foot.name = name;
  foot.joint = joint;
  foot.surface = Sphere(1e-12);
  foot.p_LE = Vector3(0, 0, -kSegment);
  foot.mirror_contact = mirror;
  foot.directions = {0, 2};
  return foot;
}

// Kelly's guess: absolute angles of stance shank and thigh, trunk, swinging thigh and shank, which change evenly into
// their mirror image.
MotionSample Guess(double fraction) {
  const double start[] = {-0.3, 0.7, 0, -0.5, -0.6};
  double angle[5], rate[5];
  for (int i = 0; i < 5; ++i) {
    angle[i] = start[i] + fraction * (start[4 - i] - start[i]);
    rate[i] = (start[4 - i] - start[i]) / kTime;
  }
  const double begin = -kSegment * (std::sin(start[0]) + std::sin(start[1]));
  MotionSample sample{VectorX(7), VectorX(7), VectorX::Zero(7), VectorX::Zero(4), VectorX(3)};
  sample.position << -kSegment * (std::sin(angle[0]) + std::sin(angle[1])) - begin,
      kSegment * (std::cos(angle[0]) + std::cos(angle[1])), angle[2], angle[1] - angle[2], angle[0] - angle[1],
      angle[3] - angle[2], angle[4] - angle[3];
  sample.velocity << -kSegment * (std::cos(angle[0]) * rate[0] + std::cos(angle[1]) * rate[1]),
      -kSegment * (std::sin(angle[0]) * rate[0] + std::sin(angle[1]) * rate[1]), rate[2], rate[1] - rate[2],
      rate[0] - rate[1], rate[3] - rate[2], rate[4] - rate[3];
  sample.forces << 0, 0, Rabbit().total_mass() * kGravity;
  return sample;
}

}  // namespace

KnownProblem FiveLinkBiped() {
  KnownProblem known;
  known.answer = {"five-link biped", 469.6501, 2e-4, 1e-6};
  known.problem = std::make_unique<OptimalControlProblem>(Rabbit());
  OptimalControlProblem& problem = *known.problem;
  problem.gravity = Vector3(0, 0, -kGravity);
  problem.contacts = {Foot("foot_r", 4, 1), Foot("foot_l", 6, 0)};
  problem.phases = {{{0}, {kTime, kTime}}};
  problem.displacement = {kStep, kStep};
  problem.plastic_touch_down = true;
  problem.friction_coefficient = 10;
  problem.swing_clearance = 0;
  problem.denominator = CostDenominator::kNothing;
  known.added.between = {{{4, 6}, {}, {}, {}}};
  CostDescription torque;
  torque.term = std::make_unique<SquaredTorqueCost>(VectorX::Ones(4), problem.Layout(0), problem.effort_size());
  problem.costs.push_back(std::move(torque));
  known.guess.durations = {kTime};
  known.guess.displacement = kStep;
  known.guess.motion = [](int, double fraction) { return Guess(fraction); };
  known.tolerance = 1e-9;
  // The stance knee is straight for a while that begins and ends within intervals: no order is seen.
  for (const Scheme scheme : {Scheme::kRadau2, Scheme::kHermiteSimpson, Scheme::kRadau3}) {
    known.runs.push_back({scheme, Mesh::Uniform({10}), 4});
  }
  return known;
}

}  // namespace rollgait
