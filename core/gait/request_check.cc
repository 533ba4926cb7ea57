#include "core/gait/request_check.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string_view>
#include <utility>

#include "core/base/nearest_word.h"

namespace rollgait {
namespace {

// Angles are given in degrees by flags and in radians by the API: both are told, as all messages of angles do.
bool IsAngle(const NumberLimits& limits) { return std::string_view(limits.unit) == "rad"; }

std::string FormatDegrees(double radians) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", radians * 180 / std::numbers::pi);
  return text;
}

std::string Describe(const NumberLimits& limits) {
  std::string text(1, limits.above_min ? '(' : '[');
  text += FormatNumber(limits.min) + ", " + FormatNumber(limits.max) + "]";
  if (limits.unit[0] != '\0') text.append(" ").append(limits.unit);
  if (!IsAngle(limits)) return text;
  return text + " (" + FormatDegrees(limits.min) + " to " + FormatDegrees(limits.max) + " deg)";
}

std::string Describe(double value, const NumberLimits& limits) {
  return FormatNumber(value) + (IsAngle(limits) ? " rad (" + FormatDegrees(value) + " deg)" : "");
}

// Written so that NaN is not inside.
bool Inside(double value, const NumberLimits& limits) {
  const bool above = limits.above_min ? value > limits.min : value >= limits.min;
  return above && value <= limits.max;
}

}  // namespace

std::string FormatNumber(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string ListNames(const std::vector<std::string>& names) {
  constexpr size_t kMaxNames = 12;
  std::string text;
  for (size_t i = 0; i < names.size() && i < kMaxNames; ++i) text += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kMaxNames) text += " and " + std::to_string(names.size() - kMaxNames) + " more";
  return text;
}

void RequestCheck::Add(std::string field, std::string message) {
  if (violations_.size() < kMaxViolations - 1) {
    violations_.push_back({std::move(field), std::move(message)});
  } else {
    ++left_out_;
  }
}

double RequestCheck::Number(const std::string& field, std::optional<double> value, double fallback,
                            const NumberLimits& limits) {
  if (!value) return fallback;
  if (!std::isfinite(*value)) {
    Add(field, FormatNumber(*value) + " is not a finite number; give a value in " + Describe(limits));
  } else if (!Inside(*value, limits)) {
    Add(field, Describe(*value, limits) + " is outside " + Describe(limits) + "; give a value in that range");
  }
  return *value;
}

int RequestCheck::Integer(const std::string& field, std::optional<int> value, int fallback, int min, int max) {
  if (!value) return fallback;
  if (*value < min || *value > max) {
    Add(field, std::to_string(*value) + " is outside [" + std::to_string(min) + ", " + std::to_string(max) +
                   "]; give a whole number in that range");
  }
  return *value;
}

void RequestCheck::Range(const std::string& field, const GaitRequest::Range& range, const NumberLimits& limits,
                         bool may_be_equal) {
  const size_t before = violations_.size() + left_out_;
  Number(field + ".min", range.min, 0, limits);
  Number(field + ".max", range.max, 0, limits);
  if (violations_.size() + left_out_ != before) return;
  if (may_be_equal ? range.min > range.max : range.min >= range.max) {
    Add(field, "min " + FormatNumber(range.min) + " must be " + (may_be_equal ? "at most" : "less than") + " max " +
                   FormatNumber(range.max));
  }
}

int RequestCheck::Joint(const std::string& field, const std::string& name, const Scene& scene, bool must_be_actuated) {
  const int index = scene.model.Find(name);
  if (index >= 0 && (!must_be_actuated || scene.model.joint(index).actuated)) return index;
  std::vector<std::string> names;
  for (const rollgait::Joint& joint : scene.model.joints()) {
    if (!must_be_actuated || joint.actuated) names.push_back(joint.name);
  }
  Add(field,
      (index < 0 ? "no joint " + Quoted(name) + " in model " + Quoted(scene.name) + DidYouMean(Printable(name), names)
                 : "joint " + Quoted(name) + " is not actuated") +
          "; choose from " + ListNames(names));
  return -1;
}

Violations RequestCheck::Take() {
  if (left_out_ == 1) {
    violations_.push_back({"", "one more violation was found; correct these first"});
  } else if (left_out_ > 1) {
    violations_.push_back({"", std::to_string(left_out_) + " more violations were found; correct these first"});
  }
  return std::move(violations_);
}

}  // namespace rollgait
