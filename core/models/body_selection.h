#ifndef ROLLGAIT_CORE_MODELS_BODY_SELECTION_H_
#define ROLLGAIT_CORE_MODELS_BODY_SELECTION_H_

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/types.h"

namespace rollgait {

struct OwnModel;

enum class Sex { kFemale, kMale };

// What touches the ground: one ellipsoid from heel to toe, or one under the heel and one under the forefoot.
enum class FootShape { kOneEllipsoid, kTwoEllipsoids };

// How far joints may go: as far as a body can, or as far as it does in walking.
enum class JointRanges { kAnatomical, kWalking };

// A rigid ellipsoid on the ground; its centre of mass is its centre.
struct RollingEllipsoid {
  Vector3 semi_axes;  // m
  double mass;        // kg
  Vector3 moments;    // kg m², principal, about the centre, along the semi-axes
};
struct RollingEllipsoidRequest {
  std::optional<Vector3> semi_axes;  // default: a ball of 0.1 m
  std::optional<double> mass;        // default: 1 kg
  std::optional<Vector3> moments;    // default: those of a homogeneous solid body
};

// A body of its own fixed to a segment of the human, on one side of paired ones: what a hand carries. Axes are those of
// the segment by the ISB, in the upright posture X forward, Y up, Z to the right, from the segment's proximal joint
// centre (SegmentTable::Body).
struct SegmentLoad {
  std::string segment;              // "hand_l", "thigh_r", "torso": SegmentName with the side
  double mass = 0;                  // kg, (0, 100]
  std::optional<Vector3> position;  // m, of its centre of mass, within ±1; default: that of the segment
  Vector3 moments = {0, 0, 0};  // kg m², principal, about its centre along the axes; 0: a point. At most mass · 1 m²
};

// What acts on a joint beside its muscles: −stiffness · (q − rest) − damping · v.
struct JointSpring {
  double stiffness = 0;  // N m/rad, [0, 1e5]
  double rest = 0;       // rad, [-π, π]
  double damping = 0;    // N m s/rad, [0, 1e4]
  bool operator==(const JointSpring&) const = default;
};

// What makes a human one of a kind. Left and right may differ; nothing of it: the human of the tables.
struct SubjectChanges {
  std::vector<SegmentLoad> loads;  // at most 16
  // Of joints by name: the share of its strength that is left, [0, 1]. Of strength 0 a joint has no muscles and no
  // passive torque: what is left is its spring.
  std::map<std::string, double> strengths;
  std::map<std::string, JointSpring> springs;  // of joints by name
  // m, of the surfaces of the feet: "foot", or "heel" and "forefoot"; with "_l" or "_r" of one side alone, which
  // wins. Length and breadth 0.5 to 1.5 times, height 0.25 to 2 times what the foot's length gives.
  std::map<std::string, Vector3> foot_semi_axes;
  // Of the same surfaces, [0.4, 1.8]: below 1 the surface is boxier than the ellipsoid that it is without an exponent,
  // above 1 more pointed.
  std::map<std::string, double> foot_exponents;
};

// Which body, as validated: see rollgait.v1.ModelSelection.
struct BodySelection {
  std::string model;
  Sex sex = Sex::kMale;
  double stature = 1.774;  // m
  double mass = 75.0;      // kg
  // m, those given, by SegmentName, or with "_l" or "_r" of one side alone, which wins over both sides.
  std::map<std::string, double> segment_lengths;
  SubjectChanges changes;
  FootShape feet = FootShape::kOneEllipsoid;
  bool toes = false;
  JointRanges ranges = JointRanges::kAnatomical;
  bool sagittal = false, drop_arms = false, rigid_trunk = false;
  std::map<std::string, double> locked_joints;   // rad, those given
  std::optional<RollingEllipsoid> rolling_body;  // if the model is one; nothing else then means anything
  bool own = false;                              // given as data (OwnModel): only `model` and `mass` mean anything
};

// The same before it is checked; empty optionals take the defaults of rollgait.v1.ModelSelection.
struct BodyRequest {
  std::string model;
  Sex sex = Sex::kMale;
  std::optional<double> stature;                  // m, [1.0, 2.3]
  std::optional<double> mass;                     // kg, [20, 250]
  std::map<std::string, double> segment_lengths;  // m, [0.7, 1.4] times what the table has
  SubjectChanges changes;
  std::optional<FootShape> feet;
  bool toes = false;
  std::optional<JointRanges> ranges;  // default: that of the model
  bool sagittal = false, drop_arms = false, rigid_trunk = false;
  std::map<std::string, double> locked_joints;  // rad, within the range of the joint
  std::optional<RollingEllipsoidRequest> rolling_body;
  // A walker given as data in place of all of the above but `model`, which is then empty or its name.
  std::shared_ptr<const OwnModel> own;  // shared: requests are copied often, and it does not change
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_MODELS_BODY_SELECTION_H_
