// What a rolling body does, for tables and pictures.
#ifndef ROLLGAIT_CLIENT_REPORT_ROLLING_PATH_H_
#define ROLLGAIT_CLIENT_REPORT_ROLLING_PATH_H_

#include <vector>

#include "client/report/motion.h"
#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/trajectory.pb.h"

namespace rollgait::client {

// Equally spaced instants from the start of a manoeuvre to its end.
struct RollingPath {
  struct Sample {
    double contact_x_m, contact_y_m;  // point of the ground that the body touches
    double center_x_m, center_y_m;
    double couple_n_m;  // magnitude of the couple on the body
  };
  double duration_s = 0;
  std::vector<Sample> samples;
  std::vector<Instant> instants;  // of the samples
};

// Of a model with one ellipsoid on the last link of a chain of three slides and three actuated revolute joints. Throws
// Failure(kUsage) that names the field if the model is another, or the trajectory does not fit it.
RollingPath BuildRollingPath(const v1::Trajectory& trajectory, const v1::Model& model);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_REPORT_ROLLING_PATH_H_
