#include "client/gait_events_table.h"

#include <cmath>

#include "client/text.h"

namespace rollgait::client {

namespace {
constexpr double kVisible = 5e-4;  // half of the last digit that is written
}  // namespace

std::string EventName(v1::GaitEvent::Kind kind) {
  switch (kind) {
    case v1::GaitEvent::KIND_HEEL_STRIKE:
      return "heel strike";
    case v1::GaitEvent::KIND_FOOT_FLAT:
      return "foot flat";
    case v1::GaitEvent::KIND_HEEL_OFF:
      return "heel off";
    case v1::GaitEvent::KIND_TOE_OFF:
      return "toe off";
    default:
      return "unknown event";
  }
}

std::string SideName(v1::Foot foot) {
  return foot == v1::FOOT_RIGHT ? "right" : foot == v1::FOOT_LEFT ? "left" : "unknown";
}

std::optional<double> FirstEvent(const v1::GaitEvents& events, v1::GaitEvent::Kind kind, v1::Foot foot) {
  for (const v1::GaitEvent& event : events.events()) {
    if (event.kind() == kind && event.foot() == foot) return event.percent();
  }
  return std::nullopt;
}

std::vector<std::vector<std::string>> GaitEventRows(const v1::GaitEvents& events) {
  std::vector<std::vector<std::string>> rows;
  if (events.feet_size() == 0) return rows;
  const auto share = [](double fraction) { return FormatNumber(100 * fraction, 3) + " %"; };
  const auto visible = [](double fraction) { return FormatVisible(100 * fraction, 1e-9, 3) + " %"; };
  rows.push_back({"  stride", FormatNumber(events.duration_s()) + " s", FormatNumber(events.displacement_m()) + " m"});
  for (const v1::FootOnGround& foot : events.feet()) {
    std::string when;
    for (const v1::GaitEvent& event : events.events()) {
      if (event.foot() != foot.foot()) continue;
      when += (when.empty() ? "" : ", ") + EventName(event.kind()) + " " + FormatNumber(event.percent(), 3);
    }
    rows.push_back({"  stance, " + SideName(foot.foot()) + " foot", share(foot.stance_fraction()), when});
  }
  for (const v1::FootOnGround& foot : events.feet()) {
    if (foot.step_length_m() == 0 && foot.step_duration_s() == 0) continue;
    rows.push_back(
        {"  step, " + SideName(foot.foot()) + " foot", FormatNumber(foot.step_length_m()) + " m",
         FormatNumber(foot.step_duration_s()) + " s, then " + share(foot.loading_fraction()) + " on both feet"});
  }
  if (std::abs(events.step_length_asymmetry()) > kVisible || std::abs(events.step_duration_asymmetry()) > kVisible ||
      std::abs(events.stance_asymmetry()) > kVisible) {
    rows.push_back({"  asymmetry, right less left", visible(events.step_length_asymmetry()),
                    "of step length, " + visible(events.step_duration_asymmetry()) + " of step duration, " +
                        visible(events.stance_asymmetry()) + " of stance"});
  }
  rows.push_back({"  double support", share(events.double_support_fraction())});
  if (events.flight_fraction() > 0) rows.push_back({"  flight", share(events.flight_fraction())});
  return rows;
}

}  // namespace rollgait::client
