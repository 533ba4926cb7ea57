// What a solve will take, from times that were measured.
#ifndef ROLLGAIT_CLIENT_PREDICT_PREDICT_TIME_H_
#define ROLLGAIT_CLIENT_PREDICT_PREDICT_TIME_H_

#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::client {

// One measured solve. Whatever it does not name has its default.
struct MeasuredTime {
  const char* model;
  v1::Preset preset;
  v1::Accuracy::Level level;
  double slope_deg, speed_m_s;
  double cpu_s;
};

// Those of client/predict/measured_times.cc.
const std::vector<MeasuredTime>& MeasuredTimes();
// The machine and the solver of these measurements, and the command that made them.
std::string SourceOfMeasuredTimes();

struct PredictedTime {
  // Without a number, why no measurement is near, as a sentence.
  std::string reason;
  // s of CPU time. `low` and `high` are as far from `cpu_s`, by their ratio, as the worst of the measured solves is
  // from what the others predict of it.
  std::optional<double> cpu_s;
  double low_s = 0, high_s = 0;
  int solves = 0;  // that it was made of
};

// By the solves of the same model, preset and level: the mean of the logarithms of their times, weighted by the inverse
// of the squared distance, where 4° and 0.4 m/s count alike. Only within the slopes and speeds of these, and only where
// the request leaves all else as it is by default.
PredictedTime PredictTime(const v1::SolveSpec& spec, const std::vector<MeasuredTime>& measured);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PREDICT_PREDICT_TIME_H_
