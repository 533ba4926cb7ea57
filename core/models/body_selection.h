#ifndef ROLLGAIT_CORE_MODELS_BODY_SELECTION_H_
#define ROLLGAIT_CORE_MODELS_BODY_SELECTION_H_

#include <map>
#include <memory>
#include <optional>
#include <string>

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

// Which body, as validated: see rollgait.v1.ModelSelection.
struct BodySelection {
  std::string model;
  Sex sex = Sex::kMale;
  double stature = 1.774;                         // m
  double mass = 75.0;                             // kg
  std::map<std::string, double> segment_lengths;  // m, those given, by SegmentName
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
