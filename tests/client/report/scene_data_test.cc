#include "client/report/scene_data.h"

#include <gtest/gtest.h>

#include <cmath>

#include "client/report/kinematics.h"
#include "client/report/packed_rows.h"
#include "client/report/stride.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

// Decodes by the definition in packed_rows.h: value i of a row.
double Value(const nlohmann::json& packed, int row, int column) {
  static const std::string kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::string& text = packed["data"].get_ref<const std::string&>();
  const auto byte = [&](size_t at) {
    unsigned group = 0;
    for (size_t k = 0; k < 4; ++k) {
      const size_t digit = kDigits.find(text.at(at / 3 * 4 + k));
      group = group << 6 | static_cast<unsigned>(digit == std::string::npos ? 0 : digit);
    }
    return group >> (16 - 8 * (at % 3)) & 0xff;
  };
  const size_t at = 2 * (static_cast<size_t>(row) * packed["columns"].get<size_t>() + column);
  const auto integer = static_cast<int16_t>(byte(at) | byte(at + 1) << 8);
  return integer == -32768 ? std::nan("") : integer * packed["scales"][row].get<double>();
}

class SceneDataTest : public testing::Test {
 protected:
  SceneDataTest() {
    for (const StrideSample& sample : BuildStride(solve_.result().trajectory(), model_, kSampleSpan_s, 200).samples) {
      instants_.push_back(sample.instant);
    }
    scene_ = SceneData(instants_, model_, solve_.result().gait_events());
  }

  const v1::Solve solve_ = SampleSolve("solves/a", 0);
  const v1::Model& model_ = solve_.result().model();
  std::vector<Instant> instants_;
  nlohmann::json scene_;
};

// Rows 7 · link on are position and quaternion of the shapes' links, against forward kinematics.
TEST_F(SceneDataTest, PosesAreThoseOfTheLinks) {
  ASSERT_EQ(scene_["poses"]["columns"], 101);
  const nlohmann::json& foot = scene_["shapes"][0];
  const int row = 7 * foot["link"].get<int>();
  const double shift = LinkPoses(model_, instants_[0].position)[5].position.x() - Value(scene_["poses"], row, 0);
  for (const int sample : {0, 40, 100}) {
    const Pose pose = LinkPoses(model_, instants_[2 * sample].position)[5];  // ankle_l
    EXPECT_NEAR(Value(scene_["poses"], row, sample) + shift, pose.position.x(), 2e-4);
    EXPECT_NEAR(Value(scene_["poses"], row + 1, sample), pose.position.y(), 1e-4);
    EXPECT_NEAR(Value(scene_["poses"], row + 2, sample), pose.position.z(), 1e-4);
    const Eigen::Quaterniond q(pose.rotation);
    double product = 0;
    const double expected[] = {q.w(), q.x(), q.y(), q.z()};
    for (int k = 0; k < 4; ++k) product += expected[k] * Value(scene_["poses"], row + 3 + k, sample);
    EXPECT_NEAR(std::abs(product), 1, 1e-4);
  }
}

TEST_F(SceneDataTest, QuaternionsDoNotChangeTheirSign) {
  for (int link = 0; link < scene_["links"].get<int>(); ++link) {
    for (int i = 1; i < 101; ++i) {
      double product = 0;
      for (int k = 3; k < 7; ++k) {
        product += Value(scene_["poses"], 7 * link + k, i - 1) * Value(scene_["poses"], 7 * link + k, i);
      }
      EXPECT_GT(product, 0.9);
    }
  }
}

// The tracks: a point of the ellipsoid in its own axes, the same point on the ground, nowhere while the foot swings.
TEST_F(SceneDataTest, ContactPointsLieOnTheFootAndOnTheGround) {
  const nlohmann::json& contact = scene_["contacts"][1];
  EXPECT_EQ(contact["name"], "right foot");
  EXPECT_EQ(contact["side"], 1);
  const int row = contact["rows"];
  int on_ground = 0;
  for (int i = 0; i <= 200; ++i) {
    const bool active = instants_[i].active[1];
    EXPECT_EQ(std::isfinite(Value(scene_["tracks"], row, i)), active);
    if (!active) continue;
    ++on_ground;
    const double a = Value(scene_["tracks"], row + 2, i) / 0.13, b = Value(scene_["tracks"], row + 3, i) / 0.05,
                 c = Value(scene_["tracks"], row + 4, i) / 0.06;
    EXPECT_NEAR(a * a + b * b + c * c, 1, 1e-3);
    EXPECT_LT(c, 0);  // the sole
  }
  EXPECT_NEAR(on_ground, 120, 2);
  // Mid-stance: the whole weight.
  EXPECT_NEAR(Value(scene_["tracks"], row + 7, 60), 100, 0.1);
}

// The centre of mass goes from its place at the start to where it is a stride later, evenly about zero.
TEST_F(SceneDataTest, TheWalkBeginsAtZero) {
  const int row = scene_["center"];
  double offset = 0;
  const double advance = Value(scene_["tracks"], row, 200) - Value(scene_["tracks"], row, 0);
  for (int i = 0; i <= 200; ++i) offset += (Value(scene_["tracks"], row, i) - advance * i / 200) / 201;
  EXPECT_NEAR(advance, 2 * kSampleDisplacement_m, 1e-3);
  EXPECT_NEAR(offset, 0, 1e-3);
  EXPECT_GT(scene_["height"].get<double>(), 1.6);
  EXPECT_LT(scene_["height"].get<double>(), 1.9);
}

}  // namespace
}  // namespace rollgait::client
