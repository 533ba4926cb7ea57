// The OpenSim files in Simbody, the multibody library below OpenSim.
#include <gtest/gtest.h>

#include <cstdio>

#include "client/formats/exported_stride.h"
#include "client/formats/opensim_motion.h"
#include "client/formats/osim.h"
#include "client/report/kinematics.h"
#include "tests/formats/opensim_reader.h"
#include "tests/formats/solved_gaits.h"

namespace rollgait::client {
namespace {

using SimTK::Vec3;

// Every coordinate that the bodies have: joint, coordinate, sign. Written out here a second time, on purpose.
struct Meaning {
  const char* joint;
  const char* coordinate;
  double sign;
};
const Meaning kMeanings[] = {
    {"base_x", "pelvis_tx", 1},
    {"base_y", "pelvis_tz", -1},
    {"base_z", "pelvis_ty", 1},
    {"base_yaw", "pelvis_rotation", 1},
    {"base_roll", "pelvis_list", 1},
    {"base_pitch", "pelvis_tilt", -1},
    {"hip_r", "hip_flexion_r", 1},
    {"hip_l", "hip_flexion_l", 1},
    {"hip_adduction_r", "hip_adduction_r", 1},
    {"hip_adduction_l", "hip_adduction_l", 1},
    {"hip_rotation_r", "hip_rotation_r", 1},
    {"hip_rotation_l", "hip_rotation_l", 1},
    {"knee_r", "knee_angle_r", 1},
    {"knee_l", "knee_angle_l", 1},
    {"ankle_r", "ankle_angle_r", 1},
    {"ankle_l", "ankle_angle_l", 1},
    {"ankle_inversion_r", "subtalar_angle_r", 1},
    {"ankle_inversion_l", "subtalar_angle_l", 1},
    {"toe_r", "mtp_angle_r", 1},
    {"toe_l", "mtp_angle_l", 1},
    {"trunk_flexion", "lumbar_extension", -1},
    {"trunk_bending", "lumbar_bending", 1},
    {"trunk_rotation", "lumbar_rotation", 1},
    {"shoulder_r", "arm_flex_r", 1},
    {"shoulder_l", "arm_flex_l", 1},
    {"shoulder_adduction_r", "arm_add_r", 1},
    {"shoulder_adduction_l", "arm_add_l", 1},
    {"shoulder_rotation_r", "arm_rot_r", 1},
    {"shoulder_rotation_l", "arm_rot_l", 1},
    {"elbow_r", "elbow_flex_r", 1},
    {"elbow_l", "elbow_flex_l", 1},
};

// Joints of a body that is no human keep their names.
Meaning MeaningOf(const std::string& joint, const v1::Model& model) {
  if (model.summary().name() == "ball") return {joint.c_str(), joint.c_str(), 1};
  for (const Meaning& meaning : kMeanings) {
    if (joint == meaning.joint) return meaning;
  }
  throw std::runtime_error("what is " + joint + "?");
}

// X forward, Y up, Z right.
Vec3 Turned(const Eigen::Vector3d& v) { return {v.x(), v.z(), -v.y()}; }

class OpensimTest : public testing::TestWithParam<std::string> {
 protected:
  void SetPoint(const StagePoint& point) {
    for (int i = 0; i < ours_.joints_size(); ++i) {
      const Meaning meaning = MeaningOf(ours_.joints(i).name(), ours_);
      osim_.Set(meaning.coordinate, meaning.sign * point.position(i), meaning.sign * point.velocity(i),
                meaning.sign * point.acceleration(i));
    }
    osim_.Realize();
  }
  // A row of the motion, at rest.
  void SetRow(const MotTable& motion, size_t row) {
    for (const v1::Joint& joint : ours_.joints()) {
      const char* const coordinate = MeaningOf(joint.name(), ours_).coordinate;
      const double unit = joint.type() == v1::Joint::TYPE_PRISMATIC ? 1 : SimTK::Pi / 180;
      osim_.Set(coordinate, unit * motion.At(row, coordinate), 0, 0);
    }
    osim_.Realize();
  }
  const std::string& LinkOf(const v1::ContactSurface& contact) const {
    return ours_.joints(contact.joint()).link_name();
  }

  v1::Solve solve_ = ReadGait(GetParam());
  const v1::Model& ours_ = solve_.result().model();
  OsimModel osim_{ToOsim(ours_, GroundOf(solve_))};
  const Stride stride_ = ExportedStride(solve_);
};

INSTANTIATE_TEST_SUITE_P(Motions, OpensimTest, testing::ValuesIn(kMotions));

TEST_P(OpensimTest, InverseDynamicsGivesTheTorques) {
  EXPECT_EQ(osim_.coordinates(), ours_.joints_size());
  EXPECT_NEAR(osim_.TotalMass(), ours_.total_mass_kg(), 1e-12 * ours_.total_mass_kg());
  double largest = 0, scale = 0;
  const std::vector<StagePoint> points = StagePoints(solve_);
  for (const StagePoint& point : points) {
    SetPoint(point);
    osim_.ClearForces();
    const std::vector<Pose> poses = LinkPoses(ours_, std::vector<double>(point.position.begin(), point.position.end()));
    for (int c = 0; c < ours_.contacts_size(); ++c) {
      const v1::ContactSurface& contact = ours_.contacts(c);
      osim_.AddForce(LinkOf(contact), Turned(point.force[c]), Turned(LowestPoint(contact, poses)), Vec3(0));
    }
    const std::map<std::string, double> torques = osim_.InverseDynamics();
    for (int i = 0; i < ours_.joints_size(); ++i) {
      const Meaning meaning = MeaningOf(ours_.joints(i).name(), ours_);
      const double difference = std::abs(torques.at(meaning.coordinate) - meaning.sign * point.effort(i));
      EXPECT_LT(difference, 1e-8) << meaning.coordinate << " at " << point.time_s;
      largest = std::max(largest, difference);
    }
    scale = std::max(scale, point.effort.cwiseAbs().maxCoeff());
  }
  EXPECT_GT(scale, LeastEffort(GetParam()));
  std::printf("%s: %zu instants, Simbody on the .osim minus ours at most %.2g N m or N, of up to %.3g\n",
              GetParam().c_str(), points.size(), largest, scale);
}

TEST_P(OpensimTest, MotionMovesTheModelAsOurs) {
  const MotTable motion = ReadMot(ToMot(solve_));
  EXPECT_TRUE(motion.in_degrees);
  ASSERT_EQ(motion.rows.size(), stride_.samples.size());
  for (size_t row = 0; row < motion.rows.size(); row += 5) {
    EXPECT_EQ(motion.At(row, "time"), stride_.samples[row].time_s);
    SetRow(motion, row);
    const std::vector<Pose> poses = LinkPoses(ours_, stride_.samples[row].instant.position);
    for (int i = 0; i < ours_.joints_size(); ++i) {
      if (!(ours_.joints(i).mass_kg() > 0)) continue;
      const SimTK::Transform body = osim_.Pose(ours_.joints(i).link_name());
      EXPECT_LT((body.p() - Turned(poses[i].position)).norm(), 1e-12) << ours_.joints(i).link_name();
      const Eigen::Matrix3d& ours = poses[i].rotation;
      EXPECT_LT((Vec3(body.R().x()) - Turned(ours.col(0))).norm(), 1e-12) << ours_.joints(i).link_name();
      EXPECT_LT((Vec3(body.R().y()) - Turned(ours.col(2))).norm(), 1e-12) << ours_.joints(i).link_name();
    }
  }
}

// The loads of the two files do to every coordinate what the contact forces do.
TEST_P(OpensimTest, ExternalLoadsAreTheContactForces) {
  const MotTable motion = ReadMot(ToMot(solve_));
  const MotTable reaction = ReadMot(ToGroundReactionMot(solve_));
  SimTK::Xml::Document loads;
  loads.readFromString(ToExternalLoads(solve_, "ground_reaction.mot"));
  SimTK::Xml::Element list = loads.getRootElement().getRequiredElement("ExternalLoads");
  EXPECT_EQ(list.getRequiredElementValue("datafile"), "ground_reaction.mot");
  double free_moment = 0;
  for (size_t row = 0; row < motion.rows.size(); ++row) {
    SetRow(motion, row);
    osim_.ClearForces();
    const Instant& instant = stride_.samples[row].instant;
    const std::vector<Pose> poses = LinkPoses(ours_, instant.position);
    for (int c = 0; c < ours_.contacts_size(); ++c) {
      const Eigen::Vector3d force(instant.force[c][0], instant.force[c][1], instant.force[c][2]);
      osim_.AddForce(LinkOf(ours_.contacts(c)), Turned(force), Turned(LowestPoint(ours_.contacts(c), poses)), Vec3(0));
    }
    const std::map<std::string, double> expected = osim_.InverseDynamics();
    osim_.ClearForces();
    for (SimTK::Xml::Element& load : list.getRequiredElement("objects").getAllElements("ExternalForce")) {
      const auto vector = [&](const char* identifier) {
        const std::string prefix = load.getRequiredElementValue(identifier);
        return Vec3(reaction.At(row, prefix + "x"), reaction.At(row, prefix + "y"), reaction.At(row, prefix + "z"));
      };
      EXPECT_EQ(load.getRequiredElementValue("force_expressed_in_body"), "ground");
      EXPECT_EQ(load.getRequiredElementValue("point_expressed_in_body"), "ground");
      const Vec3 couple = vector("torque_identifier");
      if (vector("force_identifier")[1] > 1) {
        EXPECT_EQ(vector("point_identifier")[1], 0);  // on the ground
        EXPECT_EQ(couple[0], 0);
        EXPECT_EQ(couple[2], 0);
        free_moment = std::max(free_moment, std::abs(couple[1]));
      }
      osim_.AddForce(load.getRequiredElementValue("applied_to_body"), vector("force_identifier"),
                     vector("point_identifier"), couple);
    }
    for (const auto& [coordinate, torque] : osim_.InverseDynamics()) {
      EXPECT_NEAR(torque, expected.at(coordinate), 1e-9) << coordinate << " in row " << row;
    }
  }
  // Two surfaces of one link twist the foot about the vertical; single ones do not.
  EXPECT_EQ(free_moment > 0.1, GetParam() == "human") << free_moment;
}

// What the server measured independently, foot by foot.
TEST_P(OpensimTest, ReactionIsThatOfTheGaitEvents) {
  const MotTable reaction = ReadMot(ToGroundReactionMot(solve_));
  const v1::GaitEvents& events = solve_.result().gait_events();
  if (GetParam() == "ball") {
    EXPECT_EQ(events.feet_size(), 0);
    EXPECT_GT(reaction.At(100, "ground_force_surface_vy"), 0);
    return;
  }
  ASSERT_EQ(events.feet_size(), 2);
  // The server weighs the places of the contacts by their normal forces. OpenSim takes the moment about the ground, to
  // which tangential forces add that act above or below it: by the gap at most, and by the default coefficient of
  // friction.
  const double off = 1e-6 + 0.8 * solve_.result().accuracy().max_gap_m();
  EXPECT_LT(off, 5e-4);
  int pressed = 0;
  for (const v1::FootOnGround& foot : events.feet()) {
    const std::string side = foot.foot() == v1::FOOT_RIGHT ? "r" : "l";
    const auto at = [](const v1::Matrix& matrix, size_t row, int column) {
      return matrix.values(static_cast<int>(row) * matrix.columns() + column);
    };
    for (size_t row = 0; row < reaction.rows.size(); ++row) {
      const Eigen::Vector3d force(at(foot.force_n(), row, 0), at(foot.force_n(), row, 1), at(foot.force_n(), row, 2));
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(reaction.At(row, "ground_force_" + side + "_v" + "xyz"[axis]), Turned(force)[axis], 1e-6);
      }
      if (std::isnan(at(foot.center_of_pressure_m(), row, 0))) continue;
      ++pressed;
      EXPECT_NEAR(reaction.At(row, "ground_force_" + side + "_px"), at(foot.center_of_pressure_m(), row, 0), off);
      EXPECT_NEAR(reaction.At(row, "ground_force_" + side + "_pz"), -at(foot.center_of_pressure_m(), row, 1), off);
    }
  }
  EXPECT_GT(pressed, 200);
}

// Marker trajectories: the markers of the model, moved by the motion.
TEST_P(OpensimTest, TrcHasTheMarkersOfTheModel) {
  const MotTable motion = ReadMot(ToMot(solve_));
  std::istringstream lines(ToTrc(solve_));
  std::string line, word;
  const auto split = [&line, &word] {
    std::istringstream words(line);
    std::vector<std::string> parts;
    while (std::getline(words, word, '\t')) parts.push_back(word);
    return parts;
  };
  const auto next = [&] {
    std::getline(lines, line);
    return split();
  };
  EXPECT_EQ(next()[0], "PathFileType");
  EXPECT_EQ(next()[4], "Units");
  const std::vector<std::string> facts = next();
  ASSERT_EQ(facts.size(), 8u);
  EXPECT_EQ(std::stoul(facts[2]), motion.rows.size());
  EXPECT_EQ(std::stoul(facts[3]), osim_.markers().size());
  EXPECT_EQ(facts[4], "mm");
  EXPECT_NEAR(std::stod(facts[0]), (motion.rows.size() - 1) / motion.rows.back()[0], 1e-9);
  const std::vector<std::string> names = next();
  EXPECT_EQ(next().back(), "Z" + facts[3]);
  EXPECT_TRUE(next().empty());
  for (size_t row = 0; row < motion.rows.size(); ++row) {
    const std::vector<std::string> values = next();
    ASSERT_EQ(values.size(), 2 + 3 * osim_.markers().size());
    EXPECT_EQ(std::stoul(values[0]), row + 1);
    EXPECT_EQ(std::stod(values[1]), motion.rows[row][0]);
    SetRow(motion, row);
    for (size_t m = 0; m < osim_.markers().size(); ++m) {
      const Vec3 found(std::stod(values[2 + 3 * m]), std::stod(values[3 + 3 * m]), std::stod(values[4 + 3 * m]));
      EXPECT_LT((found - 1000 * osim_.MarkerPosition(names[2 + 3 * m])).norm(), 1e-9) << names[2 + 3 * m];
    }
  }
}

TEST_P(OpensimTest, ActuatorsHaveTheEffortsAsControls) {
  int actuated = 0;
  for (const v1::Joint& joint : ours_.joints()) {
    if (!joint.actuated()) continue;
    ++actuated;
    const OsimModel::Actuator& actuator = osim_.actuators().at(MeaningOf(joint.name(), ours_).coordinate);
    EXPECT_EQ(actuator.max_control, joint.effort_max());
    EXPECT_EQ(actuator.min_control, joint.effort_min());
  }
  EXPECT_EQ(static_cast<int>(osim_.actuators().size()), actuated);
}

}  // namespace
}  // namespace rollgait::client
