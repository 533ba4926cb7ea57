#include "client/sweep/grid.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "client/failure.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

[[noreturn]] void Refuse(const std::string& flag, const std::string& text, const std::string& why) {
  throw Failure(ExitCode::kUsage, flag + " " + text + ": " + why);
}

double ParseNumber(const std::string& flag, const std::string& text, const std::string& part) {
  size_t used = 0;
  double value = NAN;
  try {
    value = std::stod(part, &used);
  } catch (const std::logic_error&) {
    used = std::string::npos;
  }
  if (used == part.size() && std::isfinite(value)) return value;
  Refuse(flag, text, "must be FROM:TO:STEP, numbers separated by commas, or one number");
}

std::vector<double> Split(const std::string& flag, const std::string& text, char separator) {
  std::vector<double> numbers;
  for (size_t start = 0; start <= text.size();) {
    const size_t end = std::min(text.find(separator, start), text.size());
    numbers.push_back(ParseNumber(flag, text, text.substr(start, end - start)));
    start = end + 1;
  }
  return numbers;
}

std::vector<double> Range(const std::string& flag, const std::string& text) {
  const std::vector<double> parts = Split(flag, text, ':');
  if (parts.size() != 3) Refuse(flag, text, "must be FROM:TO:STEP");
  const double from = parts[0], to = parts[1], step = parts[2];
  if (step == 0 || (to - from) / step < 0) Refuse(flag, text, "the step does not lead from the first to the last");
  constexpr double kRounding = 1e-9;  // of a step
  const double steps = std::floor((to - from) / step + kRounding);
  if (steps >= static_cast<double>(kMostPoints)) {
    Refuse(flag, text, "has more than " + std::to_string(kMostPoints) + " values, the most of a sweep");
  }
  std::vector<double> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    // Not 0.30000000000000004: what is printed is what is asked for.
    values.push_back(std::stod(FormatNumber(from + i * step, 12)));
  }
  return values;
}

// "slope" of "--slope".
std::string WordOf(const SweepAxis& axis) { return axis.flag.substr(2); }

}  // namespace

const std::vector<SweepAxis>& SweepAxes() {
  static const std::vector<SweepAxis> axes = {
      {"--slope", "slope_deg", &SpecFlags::slope_deg, "Inclinations of the ground, degrees"},
      {"--speed", "speed_m_s", &SpecFlags::speed_m_s, "Mean speeds along the slope, m/s"},
      {"--step-length", "step_length_m", &SpecFlags::step_length_m, "Step lengths, m"},
      {"--step-duration", "step_duration_s", &SpecFlags::step_duration_s, "Durations of a step, s"}};
  return axes;
}

std::vector<double> ParseSweepValues(const std::string& flag, const std::string& text) {
  std::vector<double> values = text.find(':') != std::string::npos ? Range(flag, text) : Split(flag, text, ',');
  std::vector<double> sorted = values;
  std::sort(sorted.begin(), sorted.end());
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) Refuse(flag, text, "has " + FormatNumber(*twice, 12) + " twice");
  return values;
}

SweepGrid MakeGrid(const std::vector<std::string>& texts) {
  SweepGrid grid;
  std::vector<SweepPoint> points = {{}};
  for (size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].empty()) continue;
    const SweepAxis& axis = SweepAxes()[i];
    const std::vector<double> values = ParseSweepValues(axis.flag, texts[i]);
    if (points.size() * values.size() > kMostPoints) {
      Refuse(axis.flag, texts[i],
             "makes " + std::to_string(points.size() * values.size()) + " points, the most of a sweep are " +
                 std::to_string(kMostPoints));
    }
    std::vector<SweepPoint> longer;
    for (const SweepPoint& point : points) {
      for (const double value : values) {
        longer.push_back(point);
        longer.back().values.push_back(value);
        longer.back().name += (point.name.empty() ? "" : "_") + WordOf(axis) + "_" + FormatNumber(value, 12);
      }
    }
    points = std::move(longer);
    grid.axes.push_back(axis);
  }
  if (grid.axes.empty()) {
    throw Failure(ExitCode::kUsage,
                  "sweep: name at least one of --slope, --speed, --step-length, --step-duration; "
                  "for example --slope -10:10:2");
  }
  grid.points = std::move(points);
  return grid;
}

}  // namespace rollgait::client
