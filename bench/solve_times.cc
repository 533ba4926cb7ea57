// What solves take, and how well it is predicted.
//   solve_times > client/predict/measured_times.cc       measures, best with nothing else to do
//   solve_times --check [--requests 40] [--seed 1]       other requests, predicted beside measured
// Both take [--models planar,human29] [--presets torque,transport,human].

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bench/measured_solve.h"
#include "client/predict/predict_time.h"
#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

struct Row {
  const char* word;
  const char* name;
  Preset preset;
  v1::Preset wire;
};
constexpr Row kPresets[] = {{"torque", "PRESET_TORQUE", Preset::kTorque, v1::PRESET_TORQUE},
                            {"transport", "PRESET_TRANSPORT", Preset::kTransport, v1::PRESET_TRANSPORT},
                            {"human", "PRESET_HUMAN", Preset::kHuman, v1::PRESET_HUMAN}};
using Level = GaitRequest::AccuracyLevel;
struct LevelRow {
  const char* name;
  Level level;
  v1::Accuracy::Level wire;
};
constexpr LevelRow kLevels[] = {{"LEVEL_DRAFT", Level::kDraft, v1::Accuracy::LEVEL_DRAFT},
                                {"LEVEL_STANDARD", Level::kStandard, v1::Accuracy::LEVEL_STANDARD},
                                {"LEVEL_FINE", Level::kFine, v1::Accuracy::LEVEL_FINE}};
constexpr double kSlopes[] = {-8, -4, 0, 4, 8}, kSpeeds[] = {1.1, 1.5};

MeasuredSolve Solve(const std::string& model, Preset preset, Level level, double slope_deg, double speed) {
  GaitRequest request;
  request.body.model = model;
  request.preset = preset;
  request.accuracy.level = level;
  request.slope = slope_deg * std::numbers::pi / 180;
  request.motion.speed = speed;
  const GaitSpec spec = CheckRequest(request).value();
  return Measure([&] { return OptimizingGaitSolver().Solve(spec, SolveControl()); });
}

std::string Machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "an unknown processor";
}

void MeasureAll(const std::vector<std::string>& models, const std::vector<std::string>& presets) {
  std::printf(R"(// Written by bench/solve_times: do not edit.
#include "client/predict/predict_time.h"

namespace rollgait::client {

std::string SourceOfMeasuredTimes() { return "solve_times, one thread of %s"; }

// Model, preset, level, slope in degrees, speed in m/s, CPU time in s.
// clang-format off
const std::vector<MeasuredTime>& MeasuredTimes() {
  static const std::vector<MeasuredTime> times = {
)",
              Machine().c_str());
  for (const std::string& model : models) {
    for (const Row& preset : kPresets) {
      if (std::find(presets.begin(), presets.end(), preset.word) == presets.end()) continue;
      for (const LevelRow& level : kLevels) {
        for (const double slope : kSlopes) {
          for (const double speed : kSpeeds) {
            const MeasuredSolve solve = Solve(model, preset.preset, level.level, slope, speed);
            std::printf("    {\"%s\", v1::%s, v1::Accuracy::%s, %g, %g, %.3g},\n", model.c_str(), preset.name,
                        level.name, slope, speed, std::max(solve.cpu, 1e-3));
            std::fflush(stdout);
          }
        }
      }
    }
  }
  std::printf(R"(  };
  return times;
}
// clang-format on

}  // namespace rollgait::client
)");
}

// Requests between the measured ones, each model, preset and level as often as another.
void Check(const std::vector<std::string>& models, int requests, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> slopes(-8, 8), speeds(1.1, 1.5);
  std::vector<double> ratios;
  int predicted = 0, within = 0;
  std::printf("%-8s %-16s %-14s %6s %6s | %9s %17s | %9s %6s\n", "model", "preset", "level", "slope", "speed",
              "predicted", "spread", "measured", "ratio");
  for (int i = 0; i < requests; ++i) {
    const size_t kinds = std::size(kPresets) * std::size(kLevels);
    const std::string& model = models[(i / kinds) % models.size()];
    const Row& preset = kPresets[i % std::size(kPresets)];
    const LevelRow& level = kLevels[i / std::size(kPresets) % std::size(kLevels)];
    const double slope = slopes(random), speed = speeds(random);
    v1::SolveSpec spec;
    spec.mutable_model()->set_name(model);
    spec.set_preset(preset.wire);
    spec.mutable_accuracy()->set_level(level.wire);
    spec.set_slope_rad(slope * std::numbers::pi / 180);
    spec.mutable_motion()->set_speed_m_s(speed);
    const client::PredictedTime time = client::PredictTime(spec, client::MeasuredTimes());
    if (!time.cpu_s) {
      std::printf("%-8s %-16s %-14s %6.1f %6.2f | %s\n", model.c_str(), preset.name, level.name, slope, speed,
                  time.reason.c_str());
      continue;
    }
    const double cpu = Solve(model, preset.preset, level.level, slope, speed).cpu, ratio = cpu / *time.cpu_s;
    const bool is_within = cpu >= time.low_s && cpu <= time.high_s;
    ++predicted;
    within += is_within;
    ratios.push_back(std::max(ratio, 1 / ratio));
    std::printf("%-8s %-16s %-14s %6.1f %6.2f | %7.2f s %7.2f to %4.2f s | %7.2f s %6.2f%s\n", model.c_str(),
                preset.name, level.name, slope, speed, *time.cpu_s, time.low_s, time.high_s, cpu, ratio,
                is_within ? "" : " outside");
    std::fflush(stdout);
  }
  if (ratios.empty()) return;
  std::sort(ratios.begin(), ratios.end());
  std::printf("%d of %d within the spread; off by a factor of %.2f in the median, %.2f in nine of ten, %.2f at most\n",
              within, predicted, ratios[ratios.size() / 2], ratios[ratios.size() * 9 / 10], ratios.back());
}

std::vector<std::string> Words(const std::string& text) {
  std::vector<std::string> words;
  std::stringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
  return words;
}

int Main(int argc, char** argv) {
  std::vector<std::string> models = {"planar", "human29"}, presets = {"torque", "transport", "human"};
  bool checks = false;
  int requests = 40;
  unsigned seed = 1;
  for (int i = 1; i < argc; ++i) {
    const std::string flag = argv[i];
    if (flag == "--check") {
      checks = true;
    } else if (i + 1 < argc && flag == "--requests") {
      requests = std::stoi(argv[++i]);
    } else if (i + 1 < argc && flag == "--seed") {
      seed = static_cast<unsigned>(std::stoi(argv[++i]));
    } else if (i + 1 < argc && flag == "--models") {
      models = Words(argv[++i]);
    } else if (i + 1 < argc && flag == "--presets") {
      presets = Words(argv[++i]);
    } else {
      std::fprintf(stderr, "solve_times: what is %s?\n", flag.c_str());
      return 2;
    }
  }
  if (checks) {
    Check(models, requests, seed);
  } else {
    MeasureAll(models, presets);
  }
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
