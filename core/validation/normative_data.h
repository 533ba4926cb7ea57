#ifndef ROLLGAIT_CORE_VALIDATION_NORMATIVE_DATA_H_
#define ROLLGAIT_CORE_VALIDATION_NORMATIVE_DATA_H_

#include <string>
#include <vector>

namespace rollgait {

// kAngle: deg, hip and knee flexion and ankle dorsiflexion positive. kMoment: N m per kg of body mass, net, internal,
// hip and knee extensor and ankle plantarflexor positive. Forces of the ground on the right foot, % of body weight:
// kVerticalForce up, kForwardForce in the direction of walking, horizontal.
enum class NormativeQuantity { kAngle, kMoment, kVerticalForce, kForwardForce };

inline constexpr int kNormativeSamples = 50;  // at 0, 2, … 98 % of the gait cycle from heel strike

// What people do: mean and standard deviation, kNormativeSamples of each.
struct NormativeCurve {
  NormativeQuantity quantity;
  std::string joint;  // "hip", "knee", "ankle"; "foot" for forces
  std::vector<double> mean;
  std::vector<double> deviation;
};

struct NormativeDataset {
  std::string name;
  std::string source;
  std::string deviation;  // of what the standard deviation is
  double speed;           // m/s, level ground
  double stride_time;     // s
  double body_mass;       // kg
  std::vector<NormativeCurve> curves;
};

// The curves of the legs in normative_gait.csv, compiled in. Any thread.
const std::vector<NormativeDataset>& NormativeDatasets();

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_NORMATIVE_DATA_H_
