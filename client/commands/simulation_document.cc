#include "client/commands/simulation_document.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "client/failure.h"
#include "client/json.h"
#include "client/output.h"

namespace rollgait::client {

SimulationDocument::SimulationDocument(std::string path, const v1::SimulationScene& scene, std::ostream& out)
    : path_(std::move(path)),
      temporary_(IsStandardOutput(path_) ? "" : path_ + ".part-" + std::to_string(getpid())),
      stream_(IsStandardOutput(path_) ? out : file_) {
  if (!temporary_.empty()) OpenFile();
  stream_ << "{\n\"scene\": " << ToJsonLine(scene) << ",\n\"samples\": [";
}

void SimulationDocument::OpenFile() {
  if (!path_.ends_with(".json")) {
    throw Failure(ExitCode::kUsage, "--output " + path_ +
                                        ": the name must end in .json; the table of samples goes to "
                                        "standard output");
  }
  file_.open(temporary_, std::ios::binary | std::ios::trunc);
  if (!file_) throw Failure(ExitCode::kUsage, "--output " + path_ + ": cannot be written: " + std::strerror(errno));
}

SimulationDocument::~SimulationDocument() {
  if (!finished_ && !temporary_.empty()) std::remove(temporary_.c_str());
}

void SimulationDocument::Add(const v1::SimulationMessage& message) {
  for (const v1::SimulationSample& sample : message.samples().samples()) {
    stream_ << (first_sample_ ? "\n" : ",\n") << ToJsonLine(sample);
    first_sample_ = false;
  }
  if (message.has_event()) events_ += (events_.empty() ? "\n" : ",\n") + ToJsonLine(message.event());
}

void SimulationDocument::Finish(const v1::SimulationReport& report) {
  stream_ << "\n],\n\"events\": [" << events_ << "\n],\n\"report\": " << ToJsonLine(report) << "\n}\n";
  stream_.flush();
  if (temporary_.empty()) {
    if (!stream_) throw Failure(ExitCode::kInternal, "standard output cannot be written");
    finished_ = true;
    return;
  }
  file_.close();
  if (!file_ || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    throw Failure(ExitCode::kInternal, path_ + ": cannot be written: " + std::strerror(errno));
  }
  finished_ = true;
}

}  // namespace rollgait::client
