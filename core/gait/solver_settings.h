#ifndef ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_
#define ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_

#include "core/gait/gait_spec.h"
#include "core/gait/start_of.h"
#include "core/nlp/nlp_options.h"

namespace rollgait {

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

// Settings of the interior point method for a program that starts so.
struct ProgramSettings {
  StartOf start;
  NlpOptions options;
};
ProgramSettings SettingsFor(StartOf start, const GaitSpec& spec);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_SOLVER_SETTINGS_H_
