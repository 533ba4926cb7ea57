// doctor: what can be wrong between this client and a server, one line each.
#include <grpc/grpc_security_constants.h>
#include <grpcpp/security/auth_context.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <vector>

#include "client/commands/commands.h"
#include "client/diagnosis.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using Level = Finding::Level;

double UnixNow() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

// Of "gait.example.org:443" and "[::1]:443"; empty for a socket.
std::string HostOf(const std::string& server) {
  if (server.rfind("unix:", 0) == 0) return "";
  const std::string host = server.substr(0, server.rfind(':'));
  return host.size() > 2 && host.front() == '[' ? host.substr(1, host.size() - 2) : host;
}

void JudgeFile(const std::string& flag, const std::string& path, std::vector<Finding>* findings) {
  if (path.empty()) return;
  std::ifstream file(path, std::ios::binary);
  const std::string pem(std::istreambuf_iterator<char>(file), {});
  findings->push_back(JudgeCertificate(flag + " " + path, pem, "", static_cast<int64_t>(UnixNow())));
}

// The certificate that the server showed in a call; without TLS there is none.
void JudgeServerCertificate(const grpc::ClientContext& context, const std::string& server,
                            std::vector<Finding>* findings) {
  const std::shared_ptr<const grpc::AuthContext> auth = context.auth_context();
  const std::vector<grpc::string_ref> pem =
      auth == nullptr ? std::vector<grpc::string_ref>() : auth->FindPropertyValues(GRPC_X509_PEM_CERT_PROPERTY_NAME);
  if (pem.empty()) {
    findings->push_back({Level::kOk, "TLS", "none: plain text", ""});
    return;
  }
  findings->push_back(JudgeCertificate("server certificate", std::string(pem[0].data(), pem[0].size()), HostOf(server),
                                       static_cast<int64_t>(UnixNow())));
}

// Adds what a call of the server shows, or why there is none.
void AskServer(const GlobalOptions& global, std::vector<Finding>* findings) try {
  Connection connection(global);
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::ServerInfo info;
  const double sent = UnixNow();
  const grpc::Status status = connection.stub().GetServerInfo(&context, {}, &info);
  const double received = UnixNow();
  RequireOk(status, "ask the server", connection.server());
  findings->push_back({Level::kOk, "server", global.server + " answered in " + FormatDuration(received - sent), ""});
  JudgeServerCertificate(context, global.server, findings);
  findings->push_back(JudgeVersion(ROLLGAIT_VERSION, info));
  findings->push_back(JudgeClock(info, sent, received));
  findings->push_back(JudgeCaller(info));
  findings->push_back(JudgeQueue(info));
  findings->push_back(JudgeDisk(info));
} catch (const Failure& failure) {
  const std::string what = failure.what();
  const size_t line = what.find('\n');
  findings->push_back(
      {Level::kFail, "server", what.substr(0, line), line == std::string::npos ? "" : what.substr(line + 1)});
}

std::string LineOf(const Finding& finding, bool color) {
  const bool ok = finding.level == Level::kOk;
  const char* const word = ok ? "ok  " : finding.level == Level::kWarn ? "warn" : "FAIL";
  return Paint(word,
               ok                              ? Tone::kGood
               : finding.level == Level::kWarn ? Tone::kBold
                                               : Tone::kBad,
               color) +
         "  " + finding.subject + ": " + finding.text + "\n" +
         (finding.advice.empty() ? "" : "      " + finding.advice + "\n");
}

}  // namespace

ExitCode RunDoctor(const GlobalOptions& global, const Terminal& terminal) {
  if (global.json) {
    throw Failure(ExitCode::kUsage,
                  "doctor --json: findings have no JSON; `rollgait server-info --json` has the facts");
  }
  std::vector<Finding> findings;
  JudgeFile("--tls-ca", global.tls_ca, &findings);
  JudgeFile("--tls-cert", global.tls_cert, &findings);
  AskServer(global, &findings);
  bool failed = false;
  for (const Finding& finding : findings) {
    failed = failed || finding.level == Level::kFail;
    if (!global.quiet || finding.level != Level::kOk) terminal.out << LineOf(finding, terminal.out_color);
  }
  terminal.out << std::flush;
  return failed ? ExitCode::kUnreachable : ExitCode::kSuccess;
}

}  // namespace rollgait::client
