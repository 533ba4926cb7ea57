#ifndef ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_
#define ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_

#include "core/gait/gait_spec.h"
#include "core/nlp/nlp_options.h"

namespace rollgait {

// What a program starts from.
enum class StartOf {
  kGuess,            // a guess that knows nothing of the solution
  kNeighbour,        // the solution of a problem that differs a little: smoother powers, pairs of bodies that were free
  kSmoother,         // the solution of this problem with smoother powers, on a coarser mesh
  kOtherRequest,     // the solution of another request
  kFinerMesh,        // the solution of this problem on a coarser mesh
  kHardlyFinerMesh,  // the same where the mesh has at most a twentieth of intervals more
  kImage,            // the solution of half of this problem and its mirror image
  kSameMesh,         // the solution of this problem on a mesh whose intervals are nowhere longer
};

// Tolerance of a program whose solution is only a start of the spec's: 1e-2, or the spec's, where that is looser.
double ToleranceOfStart(const GaitSpec& spec);

// Most iterations of one program, after which a search goes on without it. solver_settings.cc has the reasons.
struct MostIterations {
  static const int kFromGuess;      // with smooth powers
  static const int kWithoutRates;   // squared torque as it is, from a guess
  static const int kFromImage;      // both steps from one and its mirror image
  static const int kFromSymmetric;  // both steps from those of the body with both sides alike
  static const int kFromWarmStart;  // that the request names
};

// Settings of the interior point method for a program of the spec that starts so.
NlpOptions SettingsFor(StartOf start, const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_
