// Shipped scenes with some numbers, names and flags replaced: each is refused by field or simulated to a reported end.

#include <google/protobuf/util/json_util.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "server/convert/scene_convert.h"
#include "tests/fuzz/message_mutator.h"

namespace rollgait::server {
namespace {

constexpr int kMutants = 250;
constexpr int kSteps = 200;  // of the integrator, at most

std::vector<v1::SimulationScene> ShippedScenes() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(ROLLGAIT_SCENES)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<v1::SimulationScene> scenes;
  for (const auto& path : paths) {
    std::ifstream file(path);
    std::ostringstream text;
    text << file.rdbuf();
    EXPECT_TRUE(google::protobuf::util::JsonStringToMessage(text.str(), &scenes.emplace_back()).ok()) << path;
  }
  return scenes;
}

TEST(MutatedScenes, AreRefusedByFieldOrSimulatedToAnEnd) {
  const std::vector<v1::SimulationScene> shipped = ShippedScenes();
  MessageMutator mutator(20261121, MessageMutator::Reach::kValues);
  int refused = 0, simulated = 0;
  for (int i = 0; i < kMutants; ++i) {
    v1::SimulationScene message = shipped[mutator.Pick(shipped.size())];
    message.clear_output_step_s();
    for (unsigned k = 1 + mutator.Pick(4); k > 0; --k) mutator.Mutate(&message);
    const Result<SimulationScene> scene = DecodeScene(message);
    if (!scene.ok()) {
      ++refused;
      for (const Violation& violation : scene.violations()) {
        EXPECT_FALSE(violation.field.empty() || violation.message.empty()) << message.ShortDebugString();
      }
      continue;
    }
    SimulationScene bounded = scene.value();
    bounded.options.max_steps = std::min(bounded.options.max_steps, kSteps);
    int samples = 0;
    SimulationObserver observer;
    observer.sample = [&](const SimulationSample& sample) {
      EXPECT_TRUE(sample.q.allFinite() && sample.v.allFinite()) << message.ShortDebugString();
      return ++samples < 500;
    };
    const Result<SimulationReport> report = Simulate(bounded, observer);
    if (!report.ok()) continue;
    ++simulated;
    EXPECT_NE(EncodeReport(report.value(), bounded).end(), v1::SimulationReport::END_UNSPECIFIED);
  }
  EXPECT_GT(refused, kMutants / 4);
  EXPECT_GT(simulated, kMutants / 5);
}

}  // namespace
}  // namespace rollgait::server
