#include "tests/client/sample_solve.h"

#include <cmath>
#include <functional>
#include <vector>

#include "tests/client/sample_accuracy.h"

namespace rollgait::client {
namespace {

constexpr double kTwoPi = 6.28318530717958647692;
constexpr double kStride_s = 2 * kSampleSpan_s;
constexpr double kDoubleShare = 0.2;
constexpr double kThigh_m = 0.43, kShank_m = 0.43, kPelvisHeight_m = 0.92;

v1::Joint* AddJoint(v1::Model& model, const std::string& name, v1::Joint::Type type, int parent,
                    const std::string& link, double mass) {
  v1::Joint* const joint = model.add_joints();
  joint->set_name(name);
  joint->set_type(type);
  joint->set_parent(parent);
  joint->mutable_origin_m();
  joint->mutable_orientation()->set_w(1);
  joint->mutable_axis();
  joint->set_link_name(link);
  joint->set_mass_kg(mass);
  joint->mutable_center_of_mass_m();
  joint->set_position_min(-INFINITY);
  joint->set_position_max(INFINITY);
  joint->set_mirror_joint(model.joints_size() - 1);
  joint->set_mirror_sign(1);
  for (const double inertia : {0.1, 0.1, 0.02, 0.0, 0.0, 0.0}) joint->add_inertia_kg_m2(inertia);
  return joint;
}

void AddLeg(v1::Model& model, bool left) {
  const std::string suffix = left ? "_l" : "_r";
  const int first = model.joints_size();
  const auto leg_joint = [&](const char* name, int parent, double drop_m, double axis_y, const char* link,
                             double mass) {
    v1::Joint* const joint = AddJoint(model, name + suffix, v1::Joint::TYPE_REVOLUTE, parent, link + suffix, mass);
    joint->mutable_origin_m()->set_z(-drop_m);
    joint->mutable_axis()->set_y(axis_y);
    joint->set_actuated(true);
    joint->set_effort_min(-200);
    joint->set_effort_max(200);
    joint->set_position_min(-0.8);
    joint->set_position_max(2.2);
    joint->set_mirror_joint(model.joints_size() - 1 + (left ? 3 : -3));
    joint->mutable_center_of_mass_m()->set_z(-0.18);
    return joint;
  };
  leg_joint("hip", 2, 0, -1, "thigh", 9)->mutable_origin_m()->set_y(left ? 0.08 : -0.08);
  leg_joint("knee", first, kThigh_m, 1, "shank", 3.5);
  v1::Joint* const ankle = leg_joint("ankle", first + 1, kShank_m, -1, "foot", 1.0);
  ankle->mutable_center_of_mass_m()->set_x(0.05);
  ankle->mutable_center_of_mass_m()->set_z(-0.04);
  v1::ContactSurface* const foot = model.add_contacts();
  foot->set_name(left ? "left_foot" : "right_foot");
  foot->set_mirror_contact(left ? "right_foot" : "left_foot");
  foot->set_joint(first + 2);
  v1::Vector3* const axes = foot->mutable_surface()->mutable_ellipsoid()->mutable_semi_axes_m();
  axes->set_x(0.13);
  axes->set_y(0.05);
  axes->set_z(0.06);
  foot->mutable_center_m()->set_x(0.07);
  foot->mutable_center_m()->set_z(-0.02);
  foot->mutable_orientation()->set_w(1);
  foot->add_directions()->set_x(1);
  foot->add_directions()->set_z(1);
}

// Σ of two harmonics of the stride; the left leg runs half a stride ahead of the right one, which makes the motion
// mirror-periodic whatever the coefficients are.
double LegAngle(int which, double time_s) {
  static constexpr double kMean[] = {0.10, 0.38, 0.0};
  static constexpr double kFirst[] = {0.40, -0.12, 0.10};
  static constexpr double kSecond[] = {-0.03, -0.22, 0.12};
  static constexpr double kPhase[] = {0.0, 0.6, 0.9};
  const double angle = kTwoPi * time_s / kStride_s;
  return kMean[which] + kFirst[which] * std::cos(angle + kPhase[which]) +
         kSecond[which] * std::cos(2 * angle + kPhase[which]);
}

double Effort(int which, double time_s) {
  static constexpr double kAmplitude[] = {45, 30, 60};
  const double angle = kTwoPi * time_s / kStride_s;
  return kAmplitude[which] * (std::sin(angle + which) + 0.4 * std::cos(2 * angle));
}

using Function = std::function<double(double)>;

double Slope(const Function& f, double t) { return (f(t + 1e-4) - f(t - 1e-4)) / 2e-4; }
double Curvature(const Function& f, double t) { return (f(t + 1e-3) - 2 * f(t) + f(t - 1e-3)) / 1e-6; }

void SetShape(v1::Matrix* matrix, int rows, int columns) {
  matrix->set_rows(rows);
  matrix->set_columns(columns);
}

void FillPhase(const v1::Model& model, double start, double duration, int intervals, v1::TrajectoryPhase& phase) {
  const int nq = model.joints_size();
  const int points = 2 * intervals;
  phase.set_start_s(start);
  phase.set_duration_s(duration);
  const auto function = [&model](int joint) {
    return [&model, joint](double t) { return SamplePosition(model, joint, t); };
  };
  for (int k = 0; k <= intervals; ++k) {
    const double t = start + duration * k / intervals;
    phase.add_node_times_s(t);
    for (int j = 0; j < nq; ++j) {
      phase.mutable_node_positions()->add_values(SamplePosition(model, j, t));
      phase.mutable_node_velocities()->add_values(Slope(function(j), t));
    }
  }
  for (int i = 0; i < points; ++i) {
    const double t = start + duration / intervals * (i / 2 + (i % 2 == 0 ? 1.0 / 3.0 : 1.0));
    phase.add_point_times_s(t);
    for (int j = 0; j < nq; ++j) {
      phase.mutable_point_positions()->add_values(SamplePosition(model, j, t));
      phase.mutable_point_velocities()->add_values(Slope(function(j), t));
      phase.mutable_point_accelerations()->add_values(Curvature(function(j), t));
      if (model.joints(j).actuated()) {
        phase.mutable_point_efforts()->add_values(Effort((j - 3) % 3, t + (j < 6 ? kSampleSpan_s : 0)));
      }
    }
    const double weight = model.total_mass_kg() * model.gravity_m_s2();
    const double share = phase.contacts_size() == 1 ? 1.0 : (t - start) / duration;
    for (int c = 0; c < phase.contacts_size(); ++c) {
      const double normal = weight * (c == 0 ? share : 1 - share);
      for (const double force : {-0.15 * normal * std::cos(kTwoPi * t / kStride_s), 0.0, normal}) {
        phase.mutable_point_forces()->add_values(force);
      }
    }
  }
  SetShape(phase.mutable_node_positions(), intervals + 1, nq);
  SetShape(phase.mutable_node_velocities(), intervals + 1, nq);
  SetShape(phase.mutable_point_positions(), points, nq);
  SetShape(phase.mutable_point_velocities(), points, nq);
  SetShape(phase.mutable_point_accelerations(), points, nq);
  SetShape(phase.mutable_point_efforts(), points, 6);
  SetShape(phase.mutable_point_forces(), points, 3 * phase.contacts_size());
}

}  // namespace

v1::Model SampleModel() {
  v1::Model model;
  model.mutable_summary()->set_name("planar");
  model.mutable_summary()->set_description("Planar human for tests: rigid trunk, two legs, ellipsoidal feet.");
  model.mutable_summary()->set_degrees_of_freedom(9);
  model.mutable_summary()->set_actuated_joints(6);
  model.set_gravity_m_s2(9.81);
  model.set_total_mass_kg(75);
  model.set_stature_m(1.774);
  model.set_leg_length_m(kThigh_m + kShank_m + 0.08);
  model.add_sources("Round numbers made up for tests.");
  AddJoint(model, "base_x", v1::Joint::TYPE_PRISMATIC, -1, "base_slide_x", 0)->mutable_axis()->set_x(1);
  AddJoint(model, "base_z", v1::Joint::TYPE_PRISMATIC, 0, "base_slide_z", 0)->mutable_axis()->set_z(1);
  v1::Joint* const trunk = AddJoint(model, "base_pitch", v1::Joint::TYPE_REVOLUTE, 1, "trunk", 48);
  trunk->mutable_axis()->set_y(1);
  trunk->mutable_center_of_mass_m()->set_z(0.32);
  AddLeg(model, true);
  AddLeg(model, false);
  return model;
}

double SamplePosition(const v1::Model& model, int joint, double time_s) {
  const std::string& name = model.joints(joint).name();
  const double step_angle = kTwoPi * time_s / kSampleSpan_s;
  if (name == "base_x") return kSampleDisplacement_m * time_s / kSampleSpan_s + 0.01 * std::sin(step_angle);
  if (name == "base_z") return kPelvisHeight_m + 0.02 * std::cos(step_angle);
  if (name == "base_pitch") return 0.04 + 0.02 * std::cos(step_angle + 1);
  return LegAngle((joint - 3) % 3, time_s + (joint < 6 ? 0 : kSampleSpan_s));
}

v1::Trajectory SampleTrajectory(const v1::Model& model) {
  v1::Trajectory trajectory;
  for (const v1::Joint& joint : model.joints()) {
    trajectory.add_joint_names(joint.name());
    if (joint.actuated()) trajectory.add_actuated_joint_names(joint.name());
  }
  trajectory.set_scheme(v1::Discretization::SCHEME_RADAU2);
  trajectory.set_points_per_interval(2);
  trajectory.set_cycle(v1::CYCLE_HALF);
  trajectory.set_duration_s(kSampleSpan_s);
  trajectory.set_displacement_m(kSampleDisplacement_m);
  v1::TrajectoryPhase& both = *trajectory.add_phases();
  both.add_contacts("left_foot");
  both.add_contacts("right_foot");
  FillPhase(model, 0, kDoubleShare * kSampleSpan_s, 8, both);
  v1::TrajectoryPhase& single = *trajectory.add_phases();
  single.add_contacts("left_foot");
  FillPhase(model, kDoubleShare * kSampleSpan_s, (1 - kDoubleShare) * kSampleSpan_s, 24, single);
  return trajectory;
}

v1::Solve SampleSolve(const std::string& name, double slope_rad) {
  v1::Solve solve;
  solve.set_name(name);
  solve.set_state(v1::SOLVE_STATE_SUCCEEDED);
  solve.mutable_create_time()->set_seconds(1795000000);
  solve.mutable_start_time()->set_seconds(1795000001);
  solve.mutable_end_time()->set_seconds(1795000002);
  solve.set_attempts(1);
  solve.set_last_sequence(8);
  solve.mutable_spec()->mutable_model()->set_name("planar");
  solve.mutable_spec()->set_slope_rad(slope_rad);
  solve.mutable_spec()->mutable_motion()->set_speed_m_s(1.3);
  v1::SolveResult& result = *solve.mutable_result();
  result.set_termination(v1::TERMINATION_OPTIMAL);
  result.set_message("The KKT conditions hold to 1e-6.");
  *result.mutable_model() = SampleModel();
  *result.mutable_trajectory() = SampleTrajectory(result.model());
  *result.mutable_gait_events() = SampleGaitEvents(result.model());
  *result.mutable_accuracy() = SampleAccuracy();
  result.set_objective(812.5);
  v1::CostValue& cost = *result.add_costs();
  cost.set_name("squared torque");
  cost.set_weight(1);
  cost.set_value(580.9);
  cost.set_unsmoothed_value(580.9);
  cost.set_unit("N² m² s");
  cost.set_contribution(812.5);
  for (int i = 0; i < 2; ++i) {
    v1::MeshStatistics& mesh = *result.add_meshes();
    mesh.add_intervals(8 << i);
    mesh.add_intervals(16 << i);
    mesh.set_unknowns(700 << i);
    mesh.set_constraints(620 << i);
    mesh.set_jacobian_nonzeros(9000 << i);
    mesh.set_hessian_nonzeros(7000 << i);
    mesh.set_iterations(41 - 20 * i);
    mesh.set_wall_time_s(0.21);
    mesh.set_evaluation_time_s(0.05);
    mesh.set_objective(820 - 7.5 * i);
    mesh.set_kkt_error(4.4e-8);
    mesh.set_max_gap_m(2.1e-4 / (1 << (3 * i)));
    mesh.set_max_slip_m_s(3.3e-3 / (1 << (3 * i)));
  }
  result.set_speed_m_s(1.3);
  result.set_step_length_m(kSampleDisplacement_m);
  result.set_wall_time_s(0.42);
  result.set_cpu_time_s(0.41);
  result.set_peak_memory_bytes(48 << 20);
  result.set_solver_build("rollgait test build");
  solve.mutable_outcome()->set_termination(result.termination());
  solve.mutable_outcome()->set_verdict(result.accuracy().verdict());
  return solve;
}

v1::Iterate SampleIterate(const v1::Model& model, int index, int mesh) {
  const v1::Trajectory trajectory = SampleTrajectory(model);
  v1::Iterate iterate;
  iterate.set_index(index);
  iterate.set_mesh(mesh);
  *iterate.mutable_joint_names() = trajectory.joint_names();
  iterate.set_cycle(trajectory.cycle());
  iterate.set_duration_s(trajectory.duration_s());
  iterate.set_displacement_m(trajectory.displacement_m());
  for (const v1::TrajectoryPhase& phase : trajectory.phases()) {
    v1::Iterate::Phase& part = *iterate.add_phases();
    *part.mutable_contacts() = phase.contacts();
    part.set_start_s(phase.start_s());
    part.set_duration_s(phase.duration_s());
    for (const double time : phase.node_times_s()) part.add_times_s(static_cast<float>(time));
    for (const double value : phase.node_positions().values()) part.add_positions(static_cast<float>(value));
  }
  return iterate;
}

}  // namespace rollgait::client
