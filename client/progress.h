// The events of a solve as they come, for a person or for a program.
#ifndef ROLLGAIT_CLIENT_PROGRESS_H_
#define ROLLGAIT_CLIENT_PROGRESS_H_

#include <chrono>
#include <mutex>
#include <string>

#include "client/terminal.h"
#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Safe to call from several threads.
class Progress {
 public:
  enum class Style {
    kSilent,  // Nothing (--quiet).
    kLine,    // One line on a terminal, rewritten at most 20 times a second.
    kPlain,   // A line an event.
    kJson,    // An event a line as proto3 JSON on standard output; the terminal event as its bare Solve.
  };

  Progress(const Terminal& terminal, Style style) : terminal_(terminal), style_(style) {}

  void Show(const v1::SolveEvent& event);

  // Whether lines are rewritten.
  bool live() const { return style_ == Style::kLine; }

  // Text that stands on the rewritten line until the next one, cut to the terminal's width; only with kLine.
  void ShowLine(std::string text);

  // A sentence beside the events, on standard error. Silent with kSilent.
  void Note(const std::string& text);

  // Ends the rewritten line, if there is one.
  void End();

 private:
  void ShowIteration(const v1::SolveEvent& event);
  void Redraw(std::string text);
  void WriteLine(const std::string& text);

  const Terminal& terminal_;
  const Style style_;
  std::mutex mutex_;
  bool line_open_ = false;
  int iterations_shown_ = 0;
  std::string pending_;  // Newest live line that was not drawn because the last one was drawn just before.
  std::chrono::steady_clock::time_point drawn_{};
};

// One iteration as a line of fixed columns, and the line that names the columns.
std::string FormatIteration(const v1::Iteration& iteration);
std::string IterationHeader();

// One iteration as it stands on the rewritten line, at most `width` characters.
std::string FormatLiveIteration(const v1::Iteration& iteration, int width);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_PROGRESS_H_
