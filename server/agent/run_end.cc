#include "server/agent/run_end.h"

#include <signal.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstring>

#include "server/base/solver_build.h"

namespace rollgait::server {
namespace {

std::string FormatSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f s", seconds);
  return text;
}

std::string DescribeExit(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  }
  return "exit status " + std::to_string(WEXITSTATUS(status)) + " without a result";
}

bool CpuLimitReached(const RunFacts& facts) {
  if (!WIFSIGNALED(facts.process.wait_status)) return false;
  const int signal = WTERMSIG(facts.process.wait_status);
  return signal == SIGXCPU || (signal == SIGKILL && facts.process.cpu_time_s >= facts.cpu_limit_s);
}

SolveEnd EndWithResult(v1::SolveResult result, const ProcessEnd& process) {
  result.set_cpu_time_s(process.cpu_time_s);
  result.set_peak_memory_bytes(process.peak_memory_bytes);
  if (result.solver_build().empty()) result.set_solver_build(SolverBuild());
  SolveEnd end;
  end.state = SolveState::kSucceeded;
  end.reusable = result.termination() == v1::TERMINATION_OPTIMAL;
  end.result = result.SerializeAsString();
  return end;
}

}  // namespace

SolveEnd EndWithError(SolveState state, v1::SolveError::Kind kind, const std::string& message) {
  v1::SolveError error;
  error.set_kind(kind);
  error.set_message(message);
  return {state, "", error.SerializeAsString(), false};
}

std::variant<SolveEnd, Crash> JudgeRun(RunFacts facts) {
  const bool cut_short =
      !facts.last || (facts.last->has_result() && facts.last->result().termination() == v1::TERMINATION_CANCELLED);
  if (facts.cancelled && cut_short) {
    SolveEnd end = EndWithError(SolveState::kCancelled, v1::SolveError::KIND_CANCELLED, "cancelled while running");
    if (facts.last && facts.has_solution) {
      end.result = EndWithResult(std::move(*facts.last->mutable_result()), facts.process).result;
    }
    return end;
  }
  if (facts.last && facts.last->has_error()) {
    return EndWithError(SolveState::kFailed, facts.last->error().kind(), facts.last->error().message());
  }
  if (facts.last && !cut_short) return EndWithResult(std::move(*facts.last->mutable_result()), facts.process);
  if (facts.out_of_time) {
    return EndWithError(SolveState::kFailed, v1::SolveError::KIND_TIME_LIMIT,
                        "the solver did not stop at solver_limits.max_wall_time_s and was killed");
  }
  if (CpuLimitReached(facts)) {
    return EndWithError(SolveState::kFailed, v1::SolveError::KIND_TIME_LIMIT,
                        "the solver reached the CPU limit of its process after " +
                            FormatSeconds(facts.process.cpu_time_s) +
                            "; ask for fewer intervals or a smaller solver_limits.max_wall_time_s");
  }
  std::string detail = facts.last ? "stopped by a signal from outside" : DescribeExit(facts.process.wait_status);
  if (facts.stream == FrameStatus::kGarbage || facts.stream == FrameStatus::kTooLarge) {
    detail = Describe(facts.stream);
  }
  if (!facts.output.empty()) detail += "; it printed: " + facts.output;
  // Solvers ignore the other signals that come from outside (server/solve/main.cc).
  const bool was_killed = WIFSIGNALED(facts.process.wait_status) && WTERMSIG(facts.process.wait_status) == SIGKILL;
  return Crash{detail, facts.taken || !was_killed};
}

}  // namespace rollgait::server
