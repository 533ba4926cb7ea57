#include "core/models/joint_limits.h"

#include <limits>

#include "core/base/check.h"

namespace rollgait {
namespace {

// Torques are for a body of this mass, kg.
constexpr double kMass = 75;

constexpr double kFree = std::numeric_limits<double>::infinity();

constexpr JointLimits kLimits[] = {
    {"base_yaw", -kFree, kFree, -20, 20, kFree, 0},
    {"base_roll", -kLargestBaseRoll, kLargestBaseRoll, -15, 15, kFree, 0},
    {"base_pitch", -kFree, kFree, -35, 45, kFree, 0},
    {"hip", -30, 120, -30, 60, 15, 200 / kMass},
    {"hip_adduction", -45, 30, -15, 15, 15, 150 / kMass},
    {"hip_rotation", -45, 45, -20, 20, 15, 80 / kMass},
    {"knee", 0, 150, 0, 90, 20, 250 / kMass},
    {"ankle", -50, 40, -35, 35, 20, 250 / kMass},
    {"ankle_inversion", -15, 35, -15, 15, 20, 60 / kMass},
    {"toe", -45, 70, -15, 50, 30, 40 / kMass},
    {"trunk_flexion", -30, 80, -15, 25, 10, 300 / kMass},
    {"trunk_bending", -35, 35, -15, 15, 10, 150 / kMass},
    {"trunk_rotation", -45, 45, -20, 20, 10, 100 / kMass},
    {"shoulder", -60, 180, -45, 45, 20, 80 / kMass},
    {"shoulder_adduction", -80, 45, -25, 10, 20, 70 / kMass},
    {"shoulder_rotation", -90, 70, -30, 30, 20, 40 / kMass},
    {"elbow", 0, 150, 0, 70, 20, 70 / kMass},
};

}  // namespace

const JointLimits& LimitsOf(const std::string& joint) {
  for (const JointLimits& limits : kLimits) {
    if (joint == limits.joint) return limits;
  }
  ROLLGAIT_CHECK(false);
}

std::vector<std::string> JointLimitSources() {
  return {
      "Ranges of motion: hip -30..120 and ankle -50 deg, AAOS 1965 norms; knee 0..150 deg, AMA guides; 40 deg of ankle "
      "dorsiflexion are reached under weight only (lunge test). From memory of these norms.",
      "Further ranges, AAOS 1965 norms from memory: hip abduction 45, adduction 30, rotation 45 deg to both sides; "
      "foot "
      "inversion 35, eversion 15; toe joint -45..70; trunk flexion 80, extension 30, bending 35, rotation 45; shoulder "
      "-60..180, adduction 45, external rotation 90, internal 70; elbow 0..150. Shoulder abduction ends at 80 deg, "
      "before the pole of "
      "its chart at 90.",
      "Torque limits: 200 N m (hip), 250 N m (knee, ankle) at 75 kg in both directions, proportional to body mass: "
      "above "
      "the isometric maxima of young adults (Anderson, Madigan, Nussbaum 2007, J Biomech 40:3105; from memory) so that "
      "walking meets them rarely. Velocity limits: 15 rad/s (hip), 20 rad/s (knee, ankle), chosen well above walking.",
      "Further torque limits at 75 kg, chosen above what walking needs and near isometric maxima of adults (from "
      "memory, "
      "unchecked): hip adduction 150, hip rotation 80, inversion 60, toes 40, trunk 300 / 150 / 100 (flexion, bending, "
      "rotation), shoulder 80 / 70 / 40, elbow 70 N m.",
      "Ranges of walking (JointRanges): what people use between 20 deg downhill and uphill with a margin of 5 to 15 "
      "deg, "
      "after normative gait curves; chosen, from memory.",
  };
}

}  // namespace rollgait
