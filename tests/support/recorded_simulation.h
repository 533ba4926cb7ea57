#ifndef ROLLGAIT_TESTS_SUPPORT_RECORDED_SIMULATION_H_
#define ROLLGAIT_TESTS_SUPPORT_RECORDED_SIMULATION_H_

#include <gtest/gtest.h>

#include <vector>

#include "core/base/result.h"
#include "core/simulation/simulation.h"

namespace rollgait::testing {

struct RecordedSimulation {
  SimulationReport report;
  std::vector<SimulationEvent> events;
  std::vector<SimulationSample> samples;
};

// Everything that a simulation of the scene tells its observer. The calling test fails where the scene is refused.
inline RecordedSimulation Record(const SimulationScene& scene) {
  for (const Violation& violation : CheckScene(scene)) ADD_FAILURE() << violation.field << ' ' << violation.message;
  RecordedSimulation recorded;
  SimulationObserver observer;
  observer.sample = [&](const SimulationSample& sample) { return recorded.samples.push_back(sample), true; };
  observer.event = [&](const SimulationEvent& event) { return recorded.events.push_back(event), true; };
  Result<SimulationReport> report = Simulate(scene, observer);
  EXPECT_TRUE(report.ok());
  if (report.ok()) recorded.report = report.value();
  return recorded;
}

}  // namespace rollgait::testing

#endif  // ROLLGAIT_TESTS_SUPPORT_RECORDED_SIMULATION_H_
