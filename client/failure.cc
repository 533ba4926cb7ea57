#include "client/failure.h"

#include <google/protobuf/duration.pb.h>
#include <google/rpc/error_details.pb.h>
#include <google/rpc/status.pb.h>

#include <utility>

#include "client/text.h"

namespace rollgait::client {
namespace {

double Seconds(const google::rpc::RetryInfo& retry) {
  return static_cast<double>(retry.retry_delay().seconds()) + 1e-9 * retry.retry_delay().nanos();
}

// The details that the server sent with the status; none where it sent something else.
std::optional<google::rpc::Status> RichStatus(const grpc::Status& status) {
  google::rpc::Status rich;
  if (status.error_details().empty() || !rich.ParseFromString(status.error_details())) return std::nullopt;
  return rich;
}

// What the server says, with the lines that the details add, each starting with a line feed. A refused request's
// message is its first violation and how many more there are: where they are listed, it is left out.
std::string MessageWithDetails(const grpc::Status& status) {
  std::string message = status.error_message().empty() ? "" : ": " + status.error_message(), lines;
  const std::optional<google::rpc::Status> rich = RichStatus(status);
  if (!rich) return message;
  for (const google::protobuf::Any& detail : rich->details()) {
    google::rpc::BadRequest bad_request;
    google::rpc::RetryInfo retry;
    google::rpc::QuotaFailure quota;
    if (detail.UnpackTo(&bad_request)) {
      for (const auto& violation : bad_request.field_violations()) {
        lines += "\n  " + violation.field() + ": " + violation.description();
        if (status.error_message().starts_with(violation.field() + " " + violation.description())) message = "";
      }
    } else if (detail.UnpackTo(&retry)) {
      lines += "\n  the server asks to try again in " + FormatNumber(Seconds(retry), 3) + " s";
    } else if (detail.UnpackTo(&quota)) {
      for (const auto& violation : quota.violations()) {
        lines += "\n  " + violation.subject() + ": " + violation.description();
      }
    }
  }
  return message + lines;
}

std::string SceneAdvice(grpc::StatusCode code) {
  if (code == grpc::StatusCode::INVALID_ARGUMENT) {
    return "Correct the fields of the scene named above; rollgait.v1.SimulationScene "
           "(proto/rollgait/v1/simulation.proto) gives every unit and range. --validate-only checks a scene without "
           "simulating it.";
  }
  return "The run takes longer than it may: raise --max-wall-time (at most 600 s), or ask for less: a shorter "
         "--duration, a looser --tolerance. What came before is valid.";
}

// What a connection that TLS did not let through says; empty: it was not TLS.
std::string TlsAdvice(const std::string& message) {
  const auto says = [&](const char* words) { return message.find(words) != std::string::npos; };
  if (says("certificate verify failed") || says("CERTIFICATE_VERIFY_FAILED")) {
    return "The server's certificate is not one that --tls-ca (or the system's authorities) signed, or it has expired: "
           "give the right "
           "--tls-ca FILE, or renew the server's certificate.";
  }
  if (says("is not in peer certificate") || says("Hostname Verification")) {
    return "The server's certificate is for another name: call the server by a name in its certificate.";
  }
  if (says("wrong version number") || says("WRONG_VERSION_NUMBER") || says("packet length too long")) {
    return "The server does not speak TLS: omit --tls-ca and --tls-cert (beyond loopback with --insecure).";
  }
  if (says("handshake") || says("SSL_ERROR")) return "TLS failed: check --tls-ca, --tls-cert and --tls-key.";
  if (says("Invalid cert chain file") || says("key values mismatch"))
    return "--tls-cert and --tls-key do not belong together.";
  return "";
}

std::string Advice(grpc::StatusCode code, const std::string& message, const std::string& server, CallKind kind) {
  if (kind == CallKind::kScene &&
      (code == grpc::StatusCode::INVALID_ARGUMENT || code == grpc::StatusCode::DEADLINE_EXCEEDED)) {
    return SceneAdvice(code);
  }
  switch (code) {
    case grpc::StatusCode::UNAVAILABLE:
      if (message.find("Socket closed") != std::string::npos || message.find("onnection reset") != std::string::npos) {
        return "The server at " + server +
               " closed the connection. If it speaks TLS, give --tls-ca FILE; if it asks for the client's "
               "certificate, give --tls-cert and --tls-key that it accepts.";
      }
      return "Is a server running at " + server + "? Start one with `rollgaitd --data-dir DIR --listen " + server +
             "`, or name another with --server HOST:PORT.";
    case grpc::StatusCode::DEADLINE_EXCEEDED:
      return "No answer from " + server + " in time; raise --timeout or check the address.";
    case grpc::StatusCode::UNAUTHENTICATED:
      return "Give a valid token with --token-file FILE or ROLLGAIT_TOKEN; the server's administrator makes one with "
             "`rollgaitd token create`.";
    case grpc::StatusCode::PERMISSION_DENIED:
      return "The token does not allow this; the server's administrator can make one that does: `rollgaitd token "
             "create --scopes ...`.";
    case grpc::StatusCode::INVALID_ARGUMENT:
      return "Correct the values named above; `rollgait solve --help` gives the ranges.";
    case grpc::StatusCode::NOT_FOUND:
      return "`rollgait list` and `rollgait models` show what the server has.";
    case grpc::StatusCode::ALREADY_EXISTS:
      return "Use another --request-id, or repeat the request exactly as it was.";
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return "The server is busy; try again later.";
    case grpc::StatusCode::FAILED_PRECONDITION:
      return "A solve that is not finished must be cancelled first: `rollgait cancel SOLVE`.";
    case grpc::StatusCode::OUT_OF_RANGE:
      return "`rollgait get SOLVE` tells the state and the number of the newest event.";
    case grpc::StatusCode::UNIMPLEMENTED:
      return "The server at " + server + " does not offer this call; `rollgait server-info` tells its version.";
    default:
      return "";
  }
}

}  // namespace

ExitCode ExitCodeOf(const grpc::Status& status) {
  switch (status.error_code()) {
    case grpc::StatusCode::OK:
      return ExitCode::kSuccess;
    case grpc::StatusCode::INVALID_ARGUMENT:
    case grpc::StatusCode::OUT_OF_RANGE:
    case grpc::StatusCode::FAILED_PRECONDITION:
    case grpc::StatusCode::ALREADY_EXISTS:
    case grpc::StatusCode::UNAUTHENTICATED:
    case grpc::StatusCode::PERMISSION_DENIED:
      return ExitCode::kUsage;
    case grpc::StatusCode::UNAVAILABLE:
    case grpc::StatusCode::DEADLINE_EXCEEDED:
    case grpc::StatusCode::RESOURCE_EXHAUSTED:
      return ExitCode::kUnreachable;
    case grpc::StatusCode::CANCELLED:
      return ExitCode::kCancelled;
    case grpc::StatusCode::NOT_FOUND:
      return ExitCode::kNotFound;
    default:
      return ExitCode::kInternal;
  }
}

bool MissesMaxError(const v1::Solve& solve) {
  if (!solve.spec().accuracy().has_max_error()) return false;
  return !solve.result().errors().within_max_error();
}

namespace {

// Only a program that converged is judged. One that leaves constraints unmet within the bounds is of another request
// than this, with smoother powers.
ExitCode CodeWhenTimeWasUp(const v1::Solve& solve) {
  const v1::Verdict verdict = solve.result().accuracy().verdict();
  if (verdict == v1::VERDICT_EXCEEDED) return ExitCode::kMissesBound;
  if (verdict != v1::VERDICT_WITHIN || solve.result().unmet_constraints_size() > 0) return ExitCode::kNoSolution;
  return MissesMaxError(solve) ? ExitCode::kMissesBound : ExitCode::kSuccess;
}

}  // namespace

ExitCode ExitCodeOf(const v1::Solve& solve) {
  switch (solve.state()) {
    case v1::SOLVE_STATE_SUCCEEDED:
      break;
    case v1::SOLVE_STATE_FAILED:
      return solve.error().kind() == v1::SolveError::KIND_CANCELLED ? ExitCode::kCancelled : ExitCode::kRunFailed;
    case v1::SOLVE_STATE_CANCELLED:
      return ExitCode::kCancelled;
    default:
      return ExitCode::kInternal;
  }
  switch (solve.result().termination()) {
    case v1::TERMINATION_OPTIMAL:
    case v1::TERMINATION_ACCEPTABLE:
      return solve.result().accuracy().verdict() == v1::VERDICT_EXCEEDED || MissesMaxError(solve)
                 ? ExitCode::kMissesBound
                 : ExitCode::kSuccess;
    case v1::TERMINATION_TIME_LIMIT:
      return CodeWhenTimeWasUp(solve);
    case v1::TERMINATION_CANCELLED:
      return ExitCode::kCancelled;
    default:
      return ExitCode::kNoSolution;
  }
}

bool HasSolution(const v1::Solve& solve) {
  const ExitCode code = ExitCodeOf(solve);
  return code == ExitCode::kSuccess || code == ExitCode::kMissesBound;
}

std::optional<double> RetryDelay(const grpc::Status& status) {
  const std::optional<google::rpc::Status> rich = RichStatus(status);
  if (!rich) return std::nullopt;
  for (const google::protobuf::Any& detail : rich->details()) {
    google::rpc::RetryInfo retry;
    if (detail.UnpackTo(&retry)) return Seconds(retry);
  }
  return std::nullopt;
}

std::string Describe(const grpc::Status& status, const std::string& action, const std::string& server, CallKind kind) {
  std::string text = "cannot " + action + ": " + StatusCodeName(status.error_code());
  text += MessageWithDetails(status);
  std::string advice = TlsAdvice(status.error_code() == grpc::StatusCode::UNAVAILABLE ? status.error_message() : "");
  if (advice.empty()) advice = Advice(status.error_code(), status.error_message(), server, kind);
  if (!advice.empty()) text += "\n" + advice;
  return text;
}

void RequireOk(const grpc::Status& status, const std::string& action, const std::string& server, CallKind kind) {
  if (!status.ok()) throw Failure(ExitCodeOf(status), Describe(status, action, server, kind));
}

}  // namespace rollgait::client
