#include "client/tradeoff/scene_points.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "client/failure.h"
#include "client/sweep/grid.h"
#include "client/text.h"
#include "client/tradeoff/points.h"

namespace rollgait::client {
namespace {

constexpr double kLeastRelative = 1e-13, kLeastAbsolute = 1e-29, kMost = 1e-2;

const std::map<std::string, v1::DriftControl::Kind>& DriftWords() {
  static const std::map<std::string, v1::DriftControl::Kind> words = {{"projection", v1::DriftControl::KIND_PROJECTION},
                                                                      {"baumgarte", v1::DriftControl::KIND_BAUMGARTE},
                                                                      {"none", v1::DriftControl::KIND_NONE}};
  return words;
}

[[noreturn]] void RefuseScene(const std::string& flag, const std::string& text, const std::string& why) {
  throw Failure(ExitCode::kUsage, flag + " " + text + ": " + why);
}

std::vector<double> ParseTolerances(const std::string& flag, const std::string& text, double least,
                                    const std::string& range) {
  std::vector<double> values = ParseSweepValues(flag, text);
  for (const double value : values) {
    if (!(value >= least && value <= kMost)) RefuseScene(flag, text, FormatNumber(value, 12) + " must be in " + range);
  }
  return values;
}

std::vector<v1::DriftControl::Kind> ParseDrifts(const v1::SimulationScene& scene, const std::string& text) {
  if (text.empty()) {
    const bool unset = scene.drift().kind() == v1::DriftControl::KIND_UNSPECIFIED;
    return {unset ? v1::DriftControl::KIND_PROJECTION : scene.drift().kind()};
  }
  std::vector<v1::DriftControl::Kind> drifts;
  std::istringstream stream(text + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    const auto found = DriftWords().find(word);
    if (found == DriftWords().end()) {
      RefuseScene("--drift", text, "\"" + word + "\" must be one of baumgarte, none, projection");
    }
    if (std::count(drifts.begin(), drifts.end(), found->second) > 0)
      RefuseScene("--drift", text, "has " + word + " twice");
    const v1::DriftControl& own = scene.drift();
    if (word == "baumgarte" && own.frequency_1_s() == 0 && own.damping() == 0 && own.slip_rate_1_s() == 0) {
      RefuseScene("--drift", text, "baumgarte takes frequency_1_s, damping and slip_rate_1_s in the scene's drift");
    }
    drifts.push_back(found->second);
  }
  return drifts;
}

}  // namespace

std::vector<ScenePoint> MakeScenePoints(const v1::SimulationScene& scene, const std::string& tolerances,
                                        const std::string& absolutes, const std::string& drifts) {
  const auto relative = ParseTolerances("--tolerance", tolerances, kLeastRelative, "[1e-13, 1e-2]");
  std::vector<std::optional<double>> absolute;
  if (absolutes.empty()) {
    absolute.push_back(scene.has_absolute_tolerance() ? std::optional(scene.absolute_tolerance()) : std::nullopt);
  } else {
    for (const double value : ParseTolerances("--absolute-tolerance", absolutes, kLeastAbsolute, "[1e-29, 1e-2]")) {
      absolute.emplace_back(value);
    }
  }
  const auto kinds = ParseDrifts(scene, drifts);
  const size_t size = relative.size() * absolute.size() * kinds.size();
  if (size > kMostTradeoffPoints) {
    throw Failure(ExitCode::kUsage, "--tolerance, --absolute-tolerance and --drift make " + std::to_string(size) +
                                        " points, the most are " + std::to_string(kMostTradeoffPoints));
  }
  std::vector<ScenePoint> points;
  for (const v1::DriftControl::Kind kind : kinds) {
    for (const double tolerance : relative) {
      for (const std::optional<double>& value : absolute) points.push_back({tolerance, value, kind});
    }
  }
  return points;
}

ScenePoint Finer(const std::vector<ScenePoint>& points, double share) {
  ScenePoint finest = points.front();
  for (const ScenePoint& point : points) {
    finest.tolerance = std::min(finest.tolerance, point.tolerance);
    if (point.absolute) finest.absolute = std::min(*finest.absolute, *point.absolute);
  }
  finest.tolerance *= share;
  if (finest.absolute) *finest.absolute *= share;
  return finest;
}

v1::SimulationScene SceneOfPoint(v1::SimulationScene scene, const ScenePoint& point) {
  scene.set_tolerance(point.tolerance);
  if (point.absolute) {
    scene.set_absolute_tolerance(*point.absolute);
  } else {
    scene.clear_absolute_tolerance();
  }
  scene.mutable_drift()->set_kind(point.drift);
  return scene;
}

std::string DriftWord(v1::DriftControl::Kind drift) {
  for (const auto& [word, kind] : DriftWords()) {
    if (kind == drift) return word;
  }
  throw Failure(ExitCode::kUsage, "drift " + v1::DriftControl::Kind_Name(drift) + ": this client does not know it");
}

}  // namespace rollgait::client
