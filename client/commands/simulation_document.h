#ifndef ROLLGAIT_CLIENT_COMMANDS_SIMULATION_DOCUMENT_H_
#define ROLLGAIT_CLIENT_COMMANDS_SIMULATION_DOCUMENT_H_

#include <fstream>
#include <ostream>
#include <string>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::client {

// A rollgait.v1.Simulation as proto3 JSON, written sample by sample, so that a run of any length fits. The file appears
// under its name when it is whole; a run that is broken off leaves none.
class SimulationDocument {
 public:
  // Begins the document; "-" writes it to `out`, which outlives it. Throws Failure(kUsage) if the name does not end in
  // .json or the place cannot be written.
  SimulationDocument(std::string path, const v1::SimulationScene& scene, std::ostream& out);
  ~SimulationDocument();
  SimulationDocument(const SimulationDocument&) = delete;
  SimulationDocument& operator=(const SimulationDocument&) = delete;

  void Add(const v1::SimulationMessage& message);
  // Throws Failure(kInternal) if writing failed.
  void Finish(const v1::SimulationReport& report);

 private:
  void OpenFile();

  const std::string path_, temporary_;
  std::ofstream file_;
  std::ostream& stream_;  // file_, or standard output
  std::string events_;
  bool first_sample_ = true, finished_ = false;
};

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_COMMANDS_SIMULATION_DOCUMENT_H_
