#include "client/program_log.h"

#include <cmath>

#include "client/text.h"

namespace rollgait::client {
namespace {

std::string StartWords(v1::ProgramStart start) {
  switch (start) {
    case v1::PROGRAM_START_GUESS:
      return "from a guess";
    case v1::PROGRAM_START_NEIGHBOUR:
      return "from the solution of a program that differs a little";
    case v1::PROGRAM_START_SMOOTHER:
      return "from the solution with smoother powers";
    case v1::PROGRAM_START_OTHER_REQUEST:
      return "from the warm start";
    case v1::PROGRAM_START_COARSER_MESH:
      return "from the solution on the mesh before";
    case v1::PROGRAM_START_MIRROR_IMAGE:
      return "from one step and its mirror image";
    case v1::PROGRAM_START_SAME_MESH:
      return "from the solution on the same mesh";
    default:
      return "";
  }
}

std::string Intervals(const v1::MeshStatistics& program) {
  std::string text;
  for (const int count : program.intervals()) text += (text.empty() ? "" : " + ") + std::to_string(count);
  return text + " intervals";
}

}  // namespace

std::string ProgramWords(const v1::Solve& solve, const v1::MeshStatistics& program) {
  constexpr double kSameSlope = 1e-12;  // rad; rounding of the way there and back
  std::string words = StartWords(program.start());
  const auto add = [&words](const std::string& more) { words += (words.empty() ? "" : ", ") + more; };
  if (program.half_cycle() && solve.result().trajectory().cycle() != v1::CYCLE_HALF)
    add("one step with its mirror image");
  if (program.sides_alike()) add("the body with both sides alike");
  if (std::abs(program.slope_rad() - solve.spec().slope_rad()) > kSameSlope &&
      program.start() != v1::PROGRAM_START_UNSPECIFIED) {
    add("on a slope of " + FormatNumber(program.slope_rad() * 180 / kPi, 3) + "°");
  }
  if (program.added_torque_rates()) add("with a price of torque rates");
  if (program.smoothing_w() > 0) add("powers smoothed by " + FormatNumber(program.smoothing_w(), 3) + " W");
  if (program.for_errors()) add("to estimate the errors");
  return words;
}

std::vector<std::string> ProgramSentences(const v1::Solve& solve) {
  std::vector<std::string> sentences;
  for (const v1::MeshStatistics& program : solve.result().meshes()) {
    const std::string words = ProgramWords(solve, program);
    const bool ended = program.termination() != v1::TERMINATION_UNSPECIFIED;
    sentences.push_back("Program " + std::to_string(sentences.size() + 1) + (words.empty() ? "" : ", " + words) + ", " +
                        Intervals(program) + ": " + (ended ? TerminationName(program.termination()) + " after " : "") +
                        std::to_string(program.iterations()) + " iterations, objective " +
                        FormatNumber(program.objective(), 6) + ", KKT error " + FormatNumber(program.kkt_error(), 2) +
                        ", slip " + FormatNumber(1e3 * program.max_slip_m_s(), 3) + " mm/s.");
  }
  return sentences;
}

}  // namespace rollgait::client
