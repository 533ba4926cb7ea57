#include "client/commands/simulation_document.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "client/failure.h"
#include "client/json.h"

namespace rollgait::client {

SimulationDocument::SimulationDocument(std::string path, const v1::SimulationScene& scene)
    : path_(std::move(path)), temporary_(path_ + ".part-" + std::to_string(getpid())) {
  if (!path_.ends_with(".json")) {
    throw Failure(ExitCode::kUsage, "--output " + path_ +
                                        ": the name must end in .json; the table of samples goes to "
                                        "standard output");
  }
  file_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!file_) throw Failure(ExitCode::kUsage, "--output " + path_ + ": cannot be written: " + std::strerror(errno));
  file_ << "{\n\"scene\": " << ToJsonLine(scene) << ",\n\"samples\": [";
}

SimulationDocument::~SimulationDocument() {
  if (!finished_) std::remove(temporary_.c_str());
}

void SimulationDocument::Add(const v1::SimulationMessage& message) {
  for (const v1::SimulationSample& sample : message.samples().samples()) {
    file_ << (first_sample_ ? "\n" : ",\n") << ToJsonLine(sample);
    first_sample_ = false;
  }
  if (message.has_event()) events_ += (events_.empty() ? "\n" : ",\n") + ToJsonLine(message.event());
}

void SimulationDocument::Finish(const v1::SimulationReport& report) {
  file_ << "\n],\n\"events\": [" << events_ << "\n],\n\"report\": " << ToJsonLine(report) << "\n}\n";
  file_.close();
  if (!file_ || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw Failure(ExitCode::kInternal, path_ + ": cannot be written: " + std::strerror(errno));
  }
  finished_ = true;
}

}  // namespace rollgait::client
