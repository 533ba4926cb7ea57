#include "client/error_table.h"

#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr double kDegrees = 180 / kPi;

// How a quantity of ErrorEstimate is shown.
struct Display {
  const char* quantity;
  double factor;  // from the unit of the estimate to the one shown
  const char* unit;
  bool (v1::MaxError::*is_bounded)() const;
  double (v1::MaxError::*bound)() const;
};

constexpr Display kDisplays[] = {
    {"joint angle", kDegrees, "°", &v1::MaxError::has_angle_rad, &v1::MaxError::angle_rad},
    {"place", 1e3, "mm", nullptr, nullptr},
    {"angular velocity", kDegrees, "°/s", nullptr, nullptr},
    {"velocity", 1e3, "mm/s", nullptr, nullptr},
    {"joint torque", 1, "N m", &v1::MaxError::has_torque_n_m, &v1::MaxError::torque_n_m},
    {"contact force", 1, "N", &v1::MaxError::has_contact_force_n, &v1::MaxError::contact_force_n},
};

// A quantity that this program does not know is shown as the server states it.
Display DisplayOf(const v1::QuantityError& quantity) {
  for (const Display& display : kDisplays) {
    if (quantity.quantity() == display.quantity) return display;
  }
  return {quantity.quantity().c_str(), 1, quantity.unit().c_str(), nullptr, nullptr};
}

AccuracyLine WithBound(AccuracyLine line, bool is_bounded, double bound) {
  if (!is_bounded) return line;
  line.bound = bound;
  line.exceeded = !(line.value <= bound);
  return line;
}

AccuracyLine QuantityLine(const v1::QuantityError& quantity, const v1::MaxError& allowed) {
  const Display display = DisplayOf(quantity);
  const std::string unit = std::string(" ") + display.unit;
  const AccuracyLine line{"estimated error of the " + quantity.quantity(), display.factor * quantity.largest(),
                          display.unit,
                          quantity.where() + " at " + FormatNumber(quantity.time_s(), 3) + " s; RMS " +
                              FormatNumber(display.factor * quantity.rms(), 3) + unit + ", of peaks " +
                              FormatNumber(display.factor * quantity.peak(), 3) + unit,
                          "How far the trajectory is from the one on ever finer meshes, at the worst instant: √2 times "
                          "the difference from a mesh of intervals half as long."};
  const bool is_bounded = display.is_bounded != nullptr && (allowed.*display.is_bounded)();
  return WithBound(line, is_bounded, is_bounded ? display.factor * (allowed.*display.bound)() : 0);
}

}  // namespace

std::vector<AccuracyLine> ErrorLines(const v1::Solve& solve) {
  if (!solve.result().has_errors()) return {};
  const v1::ErrorEstimate& errors = solve.result().errors();
  const v1::MaxError& allowed = solve.spec().accuracy().max_error();
  std::vector<AccuracyLine> lines = {
      WithBound({"estimated error of the objective", 100 * errors.objective(), "%", "",
                 "How far the objective is from its value on ever finer meshes."},
                allowed.has_objective(), 100 * allowed.objective()),
      {"estimated error of the duration", 1e3 * errors.duration_s(), "ms", "", "Of the whole trajectory, likewise."},
      {"estimated error of the step length", 1e3 * errors.step_length_m(), "mm", "",
       "Likewise; zero where the request prescribes it."}};
  for (const v1::QuantityError& quantity : errors.quantities()) lines.push_back(QuantityLine(quantity, allowed));
  return lines;
}

}  // namespace rollgait::client
