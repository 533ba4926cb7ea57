#include "client/progress.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "client/json.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr int kLinesPerHeader = 40;
constexpr std::chrono::milliseconds kRedrawPeriod{50};

std::string StateLine(const v1::SolveEvent::StateChange& change) {
  std::string text = StateName(change.state());
  if (change.attempt() > 1) text += ", attempt " + std::to_string(change.attempt());
  if (!change.detail().empty()) text += ": " + change.detail();
  return text;
}

std::string SolutionLine(const v1::Intermediate& solution) {
  std::string text = "a gait on ";
  for (int p = 0; p < solution.intervals_size(); ++p) {
    text += (p == 0 ? "" : " + ") + std::to_string(solution.intervals(p));
  }
  text += " intervals: objective " + FormatNumber(solution.objective()) + ", " + VerdictName(solution.verdict());
  if (solution.has_errors())
    text += ", error of the objective " + FormatNumber(100 * solution.errors().objective(), 2) + " %";
  return text + ", after " + FormatDuration(solution.elapsed_s());
}

}  // namespace

std::string IterationHeader() {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), "%4s %5s   %13s  %10s  %10s  %8s  %8s  %5s  %8s", "mesh", "iter", "objective",
                "primal inf", "dual inf", "barrier", "step", "alpha", "elapsed");
  return buffer;
}

std::string FormatIteration(const v1::Iteration& iteration) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), "%4d %5d%s  %13.6e  %10.2e  %10.2e  %8.1e  %8.1e  %5.3f  %6.2f s",
                iteration.mesh(), iteration.index(), iteration.restoration() ? "r" : " ", iteration.objective(),
                iteration.primal_infeasibility(), iteration.dual_infeasibility(), iteration.barrier_parameter(),
                iteration.step_norm(), iteration.primal_step(), iteration.elapsed_s());
  return buffer;
}

std::string FormatLiveIteration(const v1::Iteration& iteration, int width) {
  char buffer[200];
  std::snprintf(buffer, sizeof(buffer), "mesh %d  iteration %d%s  objective %.6g  primal %.1e  dual %.1e  %.1f s",
                iteration.mesh(), iteration.index(), iteration.restoration() ? " (restoration)" : "",
                iteration.objective(), iteration.primal_infeasibility(), iteration.dual_infeasibility(),
                iteration.elapsed_s());
  std::string text = buffer;
  text.resize(std::min(text.size(), static_cast<size_t>(std::max(width, 1))));
  return text;
}

void Progress::Show(const v1::SolveEvent& event) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (style_ == Style::kSilent) return;
  if (style_ == Style::kJson) {
    const google::protobuf::Message& message = event;
    const google::protobuf::Message& finished = event.finished();
    terminal_.out << ToJsonLine(event.has_finished() ? finished : message) << std::endl;
    return;
  }
  if (event.has_state_change()) WriteLine(Paint(StateLine(event.state_change()), Tone::kDim, terminal_.err_color));
  if (event.has_intermediate()) WriteLine(Paint(SolutionLine(event.intermediate()), Tone::kDim, terminal_.err_color));
  if (event.has_iteration()) ShowIteration(event);
}

void Progress::ShowIteration(const v1::SolveEvent& event) {
  if (style_ == Style::kPlain) {
    if (iterations_shown_++ % kLinesPerHeader == 0) WriteLine(IterationHeader());
    WriteLine(FormatIteration(event.iteration()));
    return;
  }
  Redraw(FormatLiveIteration(event.iteration(), terminal_.err_width - 1));
}

void Progress::ShowLine(std::string text) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (style_ != Style::kLine) return;
  text.resize(std::min(text.size(), static_cast<size_t>(std::max(terminal_.err_width - 1, 1))));
  Redraw(std::move(text));
}

void Progress::Redraw(std::string text) {
  pending_ = std::move(text);
  const auto now = std::chrono::steady_clock::now();
  if (now - drawn_ < kRedrawPeriod) return;
  terminal_.err << "\r\x1b[2K" << pending_ << std::flush;
  drawn_ = now;
  pending_.clear();
  line_open_ = true;
}

void Progress::WriteLine(const std::string& text) {
  if (line_open_) terminal_.err << "\r\x1b[2K";
  line_open_ = false;
  terminal_.err << text << std::endl;
}

void Progress::Note(const std::string& text) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (style_ != Style::kSilent) WriteLine(text);
}

void Progress::End() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!pending_.empty()) {
    terminal_.err << "\r\x1b[2K" << pending_;
    line_open_ = true;
    pending_.clear();
  }
  if (line_open_) terminal_.err << std::endl;
  line_open_ = false;
}

}  // namespace rollgait::client
