// Words and numbers for people.
#ifndef ROLLGAIT_CLIENT_TEXT_H_
#define ROLLGAIT_CLIENT_TEXT_H_

#include <google/protobuf/timestamp.pb.h>
#include <grpcpp/support/status_code_enum.h>

#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

constexpr double kPi = 3.14159265358979323846;

// The number with so many significant digits, without trailing zeros; "inf", "nan" as such.
std::string FormatNumber(double value, int significant_digits = 4);

// The same, but "0" for what is smaller than `least` and so a rounding error.
std::string FormatVisible(double value, double least, int significant_digits = 4);

// The length of time with a unit that suits it: "340 µs", "12.3 ms", "4.56 s", "3 min 20 s".
std::string FormatDuration(double seconds);

// "2026-11-21 06:31:00 UTC"; "-" if unset.
std::string FormatTime(const google::protobuf::Timestamp& time);

// Lower-case words for people: "running", "iteration limit" …
std::string StateName(v1::SolveState state);
std::string TerminationName(v1::Termination termination);
// "within", "exceeded", "not judged"; the last also for a result that says nothing of it.
std::string VerdictName(v1::Verdict verdict);
std::string ErrorKindName(v1::SolveError::Kind kind);
std::string SchemeName(v1::Discretization::Scheme scheme);
// "INVALID_ARGUMENT", as gRPC spells it.
std::string StatusCodeName(grpc::StatusCode code);

// What a trajectory phase is called: the contacts that are on the ground, "left_heel + left_forefoot", or "flight".
std::string PhaseName(const v1::TrajectoryPhase& phase);

// "solves/{id}" from "solves/{id}" or "{id}". Throws Failure(kUsage) for an empty name.
std::string SolveName(const std::string& name);

// Whether the bytes are UTF-8: overlong forms, surrogates, numbers beyond U+10FFFF and cut characters are not.
bool IsUtf8(const std::string& text);

// The text with a "?" in place of every control character of ASCII: a terminal would obey some of them.
std::string WithoutControls(std::string text);

// Rows of cells as lines: columns padded to their widest cell and separated by two spaces, no trailing spaces.
// The columns whose letter in `alignment` is 'r' are set flush right; columns beyond it are flush left.
// Width counts UTF-8 characters, not bytes.
std::string FormatTable(const std::vector<std::vector<std::string>>& rows, const std::string& alignment);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_TEXT_H_
