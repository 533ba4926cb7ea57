#include "client/predict/predict_time.h"

#include <google/protobuf/message.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rollgait::client {
namespace {

constexpr double kDefaultSpeed_m_s = 1.3;  // core/gait/default_speed.h, which clients do not have
constexpr double kDegree = std::numbers::pi / 180;
// Between two measured slopes and two measured speeds, which count alike.
constexpr double kSlopeStep_deg = 4, kSpeedStep_m_s = 0.4;
// Keeps the weight of a measured solve finite; a tenth of a step away it is halved.
constexpr double kLeastDistance = 0.1;

// The first field, by its path, that is set beyond what a measured solve may have; empty: none.
std::string FirstOther(v1::SolveSpec spec) {
  spec.mutable_model()->clear_name();
  if (spec.model().ByteSizeLong() == 0) spec.clear_model();
  spec.mutable_motion()->clear_speed_m_s();
  if (spec.motion().ByteSizeLong() == 0) spec.clear_motion();
  spec.mutable_accuracy()->clear_level();
  if (spec.accuracy().ByteSizeLong() == 0) spec.clear_accuracy();
  if (spec.cycle() == v1::CYCLE_HALF) spec.clear_cycle();
  if (spec.starts() == 1) spec.clear_starts();
  spec.clear_slope_rad();
  spec.clear_preset();
  spec.mutable_solver_limits()->clear_max_wall_time_s();
  if (spec.solver_limits().ByteSizeLong() == 0) spec.clear_solver_limits();
  std::string path;
  const google::protobuf::Message* message = &spec;
  while (message != nullptr) {
    std::vector<const google::protobuf::FieldDescriptor*> fields;
    message->GetReflection()->ListFields(*message, &fields);
    if (fields.empty()) break;
    const google::protobuf::FieldDescriptor* field = fields.front();
    path += (path.empty() ? "" : ".") + field->name();
    const bool has_one = !field->is_repeated() && field->cpp_type() == field->CPPTYPE_MESSAGE;
    message = has_one ? &message->GetReflection()->GetMessage(*message, field) : nullptr;
  }
  return path;
}

double LogTime(double slope_deg, double speed_m_s, const std::vector<const MeasuredTime*>& solves,
               const MeasuredTime* without) {
  double sum = 0, weights = 0;
  for (const MeasuredTime* solve : solves) {
    if (solve == without) continue;
    const double distance =
        std::hypot((solve->slope_deg - slope_deg) / kSlopeStep_deg, (solve->speed_m_s - speed_m_s) / kSpeedStep_m_s);
    const double weight = 1 / (distance * distance + kLeastDistance * kLeastDistance);
    sum += weight * std::log(solve->cpu_s);
    weights += weight;
  }
  return sum / weights;
}

bool IsBetween(double value, double MeasuredTime::*of, const std::vector<const MeasuredTime*>& solves) {
  constexpr double kRounding = 1e-9;
  const auto [least, most] = std::minmax_element(
      solves.begin(), solves.end(), [of](const auto* one, const auto* other) { return one->*of < other->*of; });
  return value >= (*least)->*of - kRounding && value <= (*most)->*of + kRounding;
}

PredictedTime Unknown(const std::string& reason) { return {"No measurement is near: " + reason, {}, 0, 0, 0}; }

}  // namespace

PredictedTime PredictTime(const v1::SolveSpec& spec, const std::vector<MeasuredTime>& measured) {
  constexpr size_t kFewest = 4;
  const std::string other = FirstOther(spec);
  if (!other.empty()) return Unknown("the measured solves leave " + other + " as it is by default.");
  const auto level = spec.accuracy().level() == v1::Accuracy::LEVEL_UNSPECIFIED ? v1::Accuracy::LEVEL_STANDARD
                                                                                : spec.accuracy().level();
  std::vector<const MeasuredTime*> solves;
  for (const MeasuredTime& solve : measured) {
    if (spec.model().name() == solve.model && spec.preset() == solve.preset && level == solve.level) {
      solves.push_back(&solve);
    }
  }
  if (solves.size() < kFewest) return Unknown("none has this model, preset and level.");
  const double slope = spec.slope_rad() / kDegree;
  const double speed = spec.motion().has_speed_m_s() ? spec.motion().speed_m_s() : kDefaultSpeed_m_s;
  if (!IsBetween(slope, &MeasuredTime::slope_deg, solves)) return Unknown("the slope is outside those measured.");
  if (!IsBetween(speed, &MeasuredTime::speed_m_s, solves)) return Unknown("the speed is outside those measured.");
  double spread = 0;
  for (const MeasuredTime* solve : solves) {
    const double left_out = LogTime(solve->slope_deg, solve->speed_m_s, solves, solve);
    spread = std::max(spread, std::abs(left_out - std::log(solve->cpu_s)));
  }
  const double log_time = LogTime(slope, speed, solves, nullptr);
  return {"", std::exp(log_time), std::exp(log_time - spread), std::exp(log_time + spread),
          static_cast<int>(solves.size())};
}

}  // namespace rollgait::client
