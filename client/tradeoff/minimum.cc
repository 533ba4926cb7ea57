#include "client/tradeoff/minimum.h"

namespace rollgait::client {
namespace {

constexpr double kOtherMinimum = 0.5;  // of a point's error that is left on the reference's mesh
constexpr double kWellKnown = 0.5;     // of an error, as in bench/error_estimates

}  // namespace

Minimum MinimumOf(double error_deg, std::optional<double> followed_error_deg) {
  if (error_deg <= kFarAngle_deg) return Minimum::kSame;
  if (!followed_error_deg) return Minimum::kUnknown;
  return *followed_error_deg > kOtherMinimum * error_deg ? Minimum::kOther : Minimum::kSame;
}

bool IsWellKnown(double error_deg, double reference_difference_deg) {
  return reference_difference_deg <= kWellKnown * error_deg;
}

}  // namespace rollgait::client
