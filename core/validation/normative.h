#ifndef ROLLGAIT_CORE_VALIDATION_NORMATIVE_H_
#define ROLLGAIT_CORE_VALIDATION_NORMATIVE_H_

#include <optional>
#include <string>
#include <vector>

#include "core/models/scene.h"
#include "core/trajectory/trajectory.h"
#include "core/validation/gait_events.h"
#include "core/validation/normative_data.h"

namespace rollgait {

// Index of the joint of the leg on `side` that the data calls "hip", "knee" or "ankle" (by its role); -1 if the model
// has none.
int LegJoint(const Model& model, const std::string& name, BodySide side);

// How far a curve is from what people do, over equal steps of the cycle.
struct CurveDistance {
  double rms;             // root mean square of the difference, unit of the curves
  double rms_deviations;  // the same over the root mean square of the standard deviation; infinite if that is zero
  double correlation;     // Pearson's, −1 … 1; 0 if one of the two is constant
};

// Contract: same length >= 2; deviation >= 0.
CurveDistance MeasureDistance(const std::vector<double>& ours, const std::vector<double>& mean,
                              const std::vector<double>& deviation);

// One curve of the leg beside that of a data set. Units and signs: NormativeQuantity.
struct CurveComparison {
  NormativeQuantity quantity;
  std::string joint;
  std::vector<double> ours;  // kNormativeSamples
  std::vector<double> mean, deviation;
  CurveDistance distance;
  double min, max;  // ours, on a grid four times as fine
  double normative_min, normative_max;
};

// The vertical ground force of the leg's foot through its stance, % of body weight. A peak is the largest value of the
// first or the second half of stance where the force rises before it and falls after it. Two peaks: both, and the
// valley between them is at least 5 % of body weight below the lower one.
struct ForcePeaks {
  std::optional<double> first, second;  // empty: no such peak
  std::optional<double> valley;         // between the two; empty without both
  bool two = false;
};

// `force`: equally spaced through stance, any unit with `depth` for the 5 % of body weight.
ForcePeaks FindForcePeaks(const std::vector<double>& force, double depth);

// A joint of the leg's side or the trunk that lies within 0.5 deg of an end of its range, through a share of the leg's
// stance.
struct RestingJoint {
  std::string joint;
  bool at_max;   // which end
  double share;  // of stance, > 0
};

struct DatasetComparison {
  std::string dataset, source, deviation;  // as in NormativeDataset
  double speed, stride_time;               // m/s, s
  double stance;                           // share of the cycle with more than 5 % of body weight on the foot
  ForcePeaks peaks;
  std::vector<CurveComparison> curves;  // of the joints that the model has
};

struct NormativeComparison {
  double speed, stride_time, step_length;                                 // m/s, s, m: mean of both steps
  double cadence;                                                         // steps per minute
  double stance, double_support;                                          // shares of the cycle, of the leg
  std::optional<double> opposite_toe_off, opposite_heel_strike, toe_off;  // % of the cycle
  ForcePeaks peaks;
  std::vector<RestingJoint> resting;  // largest share first
  std::vector<DatasetComparison> datasets;
};

// Compares the gait cycle of one leg with normative data (level ground), which are those of a right leg. Events, shares
// and the ground's force are those of `events`, which MeasureGaitEvents made of the same scene and trajectory from the
// heel strike of `leg` on; on a slope "vertical" is
// against gravity. Joint moments are net moments, as a laboratory reports them: what muscles, ligaments and stretched
// tissue exert on the joint together. In this model that is the effort of the joint, in which the passive torque
// (core/models/passive_torque.h) is contained: costs of muscles subtract it. A laboratory obtains the same quantity by
// inverse dynamics of measured motion and forces; of a trajectory that would repeat the errors of its polynomials,
// twice differentiated, where no effort acts.
NormativeComparison CompareWithPeople(const Scene& scene, const Trajectory& trajectory, const GaitEvents& events,
                                      Foot leg = Foot::kRight);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_VALIDATION_NORMATIVE_H_
