#include "client/report/gait_events_data.h"

#include <cmath>

#include "client/failure.h"
#include "client/gait_events_table.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

void RequireShape(const v1::Matrix& matrix, int columns, const std::string& name) {
  if (matrix.rows() == kCycleSteps + 1 && matrix.columns() == columns &&
      matrix.values_size() == matrix.rows() * columns)
    return;
  throw Failure(ExitCode::kUsage, "gait_events.feet." + name + " must be " + std::to_string(kCycleSteps + 1) + " × " +
                                      std::to_string(columns) + ", is " + std::to_string(matrix.rows()) + " × " +
                                      std::to_string(matrix.columns()));
}

// Rounded to a thousandth: less than a pixel.
json Rounded(double value) { return std::isfinite(value) ? json(std::round(value * 1e3) / 1e3) : json(); }

json Column(const v1::Matrix& matrix, int column, double factor) {
  json values = json::array();
  for (int i = 0; i < matrix.rows(); ++i)
    values.push_back(Rounded(factor * matrix.values(i * matrix.columns() + column)));
  return values;
}

// Each unbroken stretch from its own first value on, mm.
json Advance(const v1::Matrix& pressure) {
  json values = json::array();
  double first = std::nan("");
  for (int i = 0; i < pressure.rows(); ++i) {
    const double x = pressure.values(i * pressure.columns());
    if (std::isnan(x) || std::isnan(first)) first = x;
    values.push_back(Rounded(1e3 * (x - first)));
  }
  return values;
}

}  // namespace

void RequireInstants(const v1::FootOnGround& foot) {
  RequireShape(foot.force_n(), 3, "force_n");
  RequireShape(foot.level_force_n(), 3, "level_force_n");
  RequireShape(foot.center_of_pressure_m(), 2, "center_of_pressure_m");
}

json GaitEventsData(const v1::GaitEvents& events, const v1::Model& model) {
  json data = {{"phases", json::array()},
               {"events", json::array()},
               {"feet", json::array()},
               {"double_support", json()},
               {"flight", json()}};
  if (events.feet_size() == 0) return data;
  for (const v1::SupportPhase& phase : events.phases()) {
    data["phases"].push_back({{"start", phase.start_percent()},
                              {"end", phase.end_percent()},
                              {"contacts", std::vector<std::string>(phase.contacts().begin(), phase.contacts().end())},
                              {"feet", phase.feet_size()}});
  }
  for (const v1::GaitEvent& event : events.events()) {
    data["events"].push_back(
        {{"percent", event.percent()}, {"foot", SideName(event.foot())}, {"name", EventName(event.kind())}});
  }
  const double percent = 100 / (model.total_mass_kg() * model.gravity_m_s2());
  for (const v1::FootOnGround& foot : events.feet()) {
    RequireInstants(foot);
    data["feet"].push_back({{"name", SideName(foot.foot()) + " foot"},
                            {"right", foot.foot() == v1::FOOT_RIGHT},
                            {"stance", foot.stance_fraction()},
                            {"step_length", foot.step_length_m()},
                            {"step_duration", foot.step_duration_s()},
                            {"loading", foot.loading_fraction()},
                            {"normal", Column(foot.force_n(), 2, percent)},
                            {"along", Column(foot.force_n(), 0, percent)},
                            {"sideways", Column(foot.force_n(), 1, percent)},
                            {"vertical", Column(foot.level_force_n(), 2, percent)},
                            {"forward", Column(foot.level_force_n(), 0, percent)},
                            {"pressure", Advance(foot.center_of_pressure_m())}});
  }
  data["double_support"] = events.double_support_fraction();
  data["flight"] = events.flight_fraction();
  return data;
}

}  // namespace rollgait::client
