#include "client/normative_table.h"

#include "client/text.h"

namespace rollgait::client {
namespace {

std::string Range(double min, double max, const std::string& unit) {
  return FormatNumber(min, 3) + " … " + FormatNumber(max, 3) + " " + unit;
}

std::string RestingJoints(const v1::NormativeComparison& people) {
  std::string text;
  for (const v1::RestingJoint& resting : people.resting_joints()) {
    if (resting.stance_fraction() < 0.5) continue;
    text += (text.empty() ? "" : ", ") + resting.joint() + (resting.at_max() ? " (upper, " : " (lower, ") +
            FormatNumber(100 * resting.stance_fraction(), 3) + " %)";
  }
  return text.empty() ? "none" : text;
}

}  // namespace

std::string ForcePeaksText(const v1::ForcePeaks& peaks) {
  const auto text = [](bool has, double value) { return has ? FormatNumber(value, 3) : std::string("-"); };
  return text(peaks.has_first_percent_bw(), peaks.first_percent_bw()) + " / " +
         text(peaks.has_valley_percent_bw(), peaks.valley_percent_bw()) + " / " +
         text(peaks.has_second_percent_bw(), peaks.second_percent_bw()) + " %";
}

std::string QuantityUnit(v1::NormativeCurve::Quantity quantity) {
  switch (quantity) {
    case v1::NormativeCurve::QUANTITY_ANGLE:
      return "°";
    case v1::NormativeCurve::QUANTITY_MOMENT:
      return "N m/kg";
    default:
      return "% of weight";
  }
}

std::vector<std::vector<std::string>> NormativeRows(const v1::NormativeComparison& people) {
  std::vector<std::vector<std::string>> rows;
  if (people.datasets_size() == 0) return rows;
  const auto percent = [](double fraction) { return FormatNumber(100 * fraction, 3) + " %"; };
  rows.push_back({"  stance", percent(people.stance_fraction())});
  rows.push_back({"  double support", percent(people.double_support_fraction())});
  rows.push_back({"  cadence", FormatNumber(people.cadence_per_min(), 3) + " /min"});
  rows.push_back({"  vertical GRF: first peak / valley / second peak", ForcePeaksText(people.vertical_force())});
  rows.push_back({"  joints at a limit for ≥ 50 % of stance", RestingJoints(people)});
  for (const v1::NormativeDatasetComparison& set : people.datasets()) {
    rows.push_back({"  " + set.name() + ": stance " + percent(set.stance_fraction()) + ", force " +
                    ForcePeaksText(set.vertical_force())});
    for (const v1::NormativeCurve& curve : set.curves()) {
      const bool angle = curve.quantity() == v1::NormativeCurve::QUANTITY_ANGLE;
      if (!angle && curve.quantity() != v1::NormativeCurve::QUANTITY_MOMENT) continue;
      const std::string unit = QuantityUnit(curve.quantity());
      rows.push_back({"    " + curve.joint() + (angle ? " angle" : " moment"),
                      "correlation " + FormatNumber(curve.correlation(), 2),
                      "rms " + FormatNumber(curve.rms(), 3) + " " + unit,
                      FormatNumber(curve.rms_deviations(), 3) + " SD",
                      "range " + Range(curve.min(), curve.max(), unit) + ", people " +
                          Range(curve.normative_min(), curve.normative_max(), unit)});
    }
  }
  return rows;
}

}  // namespace rollgait::client
