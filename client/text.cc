#include "client/text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <iterator>
#include <nlohmann/json.hpp>

#include "client/failure.h"

namespace rollgait::client {
namespace {

// The part of an enumerator's name behind the prefix, in lower case with spaces.
std::string Words(const std::string& enumerator, const std::string& prefix) {
  std::string words = enumerator.rfind(prefix, 0) == 0 ? enumerator.substr(prefix.size()) : enumerator;
  for (char& letter : words) {
    letter = letter == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return words;
}

size_t Width(const std::string& text) {
  return static_cast<size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string FormatNumber(double value, int significant_digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), "%.*g", significant_digits, value);
  return buffer;
}

std::string FormatVisible(double value, double least, int significant_digits) {
  return FormatNumber(std::abs(value) < least ? 0 : value, significant_digits);
}

std::string FormatDuration(double seconds) {
  if (!std::isfinite(seconds)) return FormatNumber(seconds);
  if (seconds < 1e-3) return FormatNumber(seconds * 1e6, 3) + " µs";
  if (seconds < 1.0) return FormatNumber(seconds * 1e3, 3) + " ms";
  if (seconds < 60.0) return FormatNumber(seconds, 3) + " s";
  const long whole = std::lround(seconds);
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

std::string FormatTime(const google::protobuf::Timestamp& time) {
  if (time.seconds() == 0) return "-";
  const std::time_t seconds = time.seconds();
  std::tm utc{};
  if (gmtime_r(&seconds, &utc) == nullptr) return "-";
  char buffer[64];
  std::strftime(buffer, sizeof(buffer), "%Y-%m-%d %H:%M:%S UTC", &utc);
  return buffer;
}

std::string StateName(v1::SolveState state) { return Words(v1::SolveState_Name(state), "SOLVE_STATE_"); }

std::string TerminationName(v1::Termination termination) {
  return Words(v1::Termination_Name(termination), "TERMINATION_");
}

std::string VerdictName(v1::Verdict verdict) {
  return Words(v1::Verdict_Name(verdict == v1::VERDICT_UNSPECIFIED ? v1::VERDICT_NOT_JUDGED : verdict), "VERDICT_");
}

std::string ErrorKindName(v1::SolveError::Kind kind) { return Words(v1::SolveError::Kind_Name(kind), "KIND_"); }

std::string SchemeName(v1::Discretization::Scheme scheme) {
  if (scheme == v1::Discretization::SCHEME_UNSPECIFIED) return "default scheme";
  std::string name = v1::Discretization::Scheme_Name(scheme);
  for (const auto& [prefix, family] :
       {std::pair("SCHEME_RADAU", "Radau IIA, "), std::pair("SCHEME_LOBATTO", "Lobatto IIIA, ")}) {
    if (name.rfind(prefix, 0) == 0) return family + name.substr(std::string(prefix).size()) + " points";
  }
  const std::string shooting = "SCHEME_SHOOTING_";
  if (name.rfind(shooting, 0) == 0) return "direct multiple shooting, " + Words(name, shooting) + " efforts";
  return scheme == v1::Discretization::SCHEME_HERMITE_SIMPSON ? "Hermite–Simpson" : Words(name, "SCHEME_");
}

std::string StatusCodeName(grpc::StatusCode code) {
  static const char* const kNames[] = {
      "OK",        "CANCELLED",      "UNKNOWN",           "INVALID_ARGUMENT",   "DEADLINE_EXCEEDED",
      "NOT_FOUND", "ALREADY_EXISTS", "PERMISSION_DENIED", "RESOURCE_EXHAUSTED", "FAILED_PRECONDITION",
      "ABORTED",   "OUT_OF_RANGE",   "UNIMPLEMENTED",     "INTERNAL",           "UNAVAILABLE",
      "DATA_LOSS", "UNAUTHENTICATED"};
  const int index = static_cast<int>(code);
  return index >= 0 && index < static_cast<int>(std::size(kNames)) ? kNames[index] : "status " + std::to_string(index);
}

std::string PhaseName(const v1::TrajectoryPhase& phase) {
  std::string name;
  for (const std::string& contact : phase.contacts()) name += (name.empty() ? "" : " + ") + contact;
  return name.empty() ? "flight" : name;
}

std::string SolveName(const std::string& name) {
  if (name.empty() || name == "solves/") {
    throw Failure(ExitCode::kUsage,
                  "a solve's name is empty; `rollgait list` shows the names, for example solves/1a2b");
  }
  return name.rfind("solves/", 0) == 0 ? name : "solves/" + name;
}

bool IsUtf8(const std::string& text) {
  try {
    nlohmann::json(text).dump();  // which is strict
    return true;
  } catch (const nlohmann::json::type_error&) {
    return false;
  }
}

std::string WithoutControls(std::string text) {
  const auto is_control = [](unsigned char c) { return c < ' ' || c == 0x7f; };
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

std::string FormatTable(const std::vector<std::vector<std::string>>& rows, const std::string& alignment) {
  std::vector<size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], Width(row[i]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - Width(row[i]), ' ');
      const bool right = i < alignment.size() && alignment[i] == 'r';
      line += (i == 0 ? "" : "  ") + (right ? padding + row[i] : row[i] + padding);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace rollgait::client
