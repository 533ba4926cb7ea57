#include "client/diagnosis.h"

#include <algorithm>
#include <cmath>

#include "client/certificate.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using Level = Finding::Level;

std::string Date(int64_t seconds) {
  google::protobuf::Timestamp time;
  time.set_seconds(seconds);
  return FormatTime(time);
}

// "0.4" of "0.4.0".
std::string MajorAndMinor(const std::string& version) {
  const size_t dot = version.find('.');
  return version.substr(0, dot == std::string::npos ? dot : version.find('.', dot + 1));
}

std::string Listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "no name" : text;
}

}  // namespace

Finding JudgeVersion(const std::string& client_version, const v1::ServerInfo& info) {
  const std::string text = "client " + client_version + ", server " + info.version() + ", API rollgait.v1";
  if (MajorAndMinor(client_version) == MajorAndMinor(info.version())) return {Level::kOk, "versions", text, ""};
  return {Level::kWarn, "versions", text,
          "Fields that one of the two does not know are ignored: use the same version on both sides."};
}

Finding JudgeClock(const v1::ServerInfo& info, double sent_s, double received_s) {
  if (!info.has_server_time()) {
    return {Level::kOk, "clock", "the server does not tell its time (0.4.0 or before)", ""};
  }
  const double server_s =
      static_cast<double>(info.server_time().seconds()) + 1e-9 * static_cast<double>(info.server_time().nanos());
  const double ahead = server_s - (sent_s + received_s) / 2, unsure = (received_s - sent_s) / 2;
  const std::string text = "the server's clock is " + FormatDuration(std::abs(ahead)) +
                           (ahead < 0 ? " behind" : " ahead of") + " ours, to within " + FormatDuration(unsure);
  if (std::abs(ahead) <= 2 + unsure) return {Level::kOk, "clock", text, ""};
  return {Level::kWarn, "clock", text,
          "Set both clocks by NTP: certificates and tokens are judged by them, and `rollgait list --since` uses ours."};
}

Finding JudgeQueue(const v1::ServerInfo& info) {
  // Without slots of its own the server leaves solving to agents elsewhere, of which it knows nothing.
  std::string text = info.solver_slots() > 0 ? std::to_string(info.running()) + " of " +
                                                   std::to_string(info.solver_slots()) + " solver slots are busy, "
                                             : std::to_string(info.running()) + " solves run on agents elsewhere, ";
  text += std::to_string(info.queued()) + " solves wait";
  if (info.max_queued() > 0) text += " of at most " + std::to_string(info.max_queued());
  if (info.max_queued() > 0 && info.queued() >= info.max_queued()) {
    return {Level::kFail, "queue", text, "New solves are refused until one ends; cancel some with `rollgait cancel`."};
  }
  if (info.max_queued() > 0 && info.queued() >= 0.8 * info.max_queued()) {
    return {Level::kWarn, "queue", text, "The queue is nearly full; new solves will wait long or be refused."};
  }
  return {Level::kOk, "queue", text, ""};
}

Finding JudgeDisk(const v1::ServerInfo& info) {
  const std::string store = "store: " + info.store();
  if (!info.has_store_free_bytes()) {
    return {Level::kOk, "disk", store + "; the server does not tell what is free there", ""};
  }
  const double mebibytes = static_cast<double>(info.store_free_bytes()) / 1048576;
  const std::string text =
      store + ", " +
      (mebibytes < 1024 ? FormatNumber(mebibytes, 3) + " MiB" : FormatNumber(mebibytes / 1024, 4) + " GiB") + " free";
  const std::string advice =
      "Free room on the disk of the store, or let the server keep less (docs/explanation/stores.md).";
  if (mebibytes < 64) return {Level::kFail, "disk", text, "New solves are refused. " + advice};
  if (mebibytes < 1024) return {Level::kWarn, "disk", text, advice};
  return {Level::kOk, "disk", text, ""};
}

Finding JudgeCaller(const v1::ServerInfo& info) {
  const v1::Caller& caller = info.caller();
  const bool off = caller.authentication() == v1::Caller::AUTHENTICATION_OFF ||
                   caller.authentication() == v1::Caller::AUTHENTICATION_UNSPECIFIED;
  if (off) return {Level::kOk, "access", "the server does not ask who calls", ""};
  std::string scopes;
  for (const std::string& scope : caller.scopes()) scopes += (scopes.empty() ? "" : ", ") + scope;
  const std::string text = "tenant " + caller.tenant() + ", as " + caller.identity() + ", may: " + scopes;
  const bool may_solve = std::find(caller.scopes().begin(), caller.scopes().end(), "solve") != caller.scopes().end();
  if (may_solve) return {Level::kOk, "access", text, ""};
  return {
      Level::kWarn, "access", text,
      "Solves cannot be asked for; the administrator makes a token that may with `rollgaitd token create --scopes`."};
}

Finding JudgeCertificate(const std::string& subject, const std::string& pem, const std::string& host, int64_t now_s) {
  const std::optional<Certificate> certificate = ReadCertificate(pem);
  if (!certificate) return {Level::kFail, subject, "is not an X.509 certificate in PEM", "Give another file."};
  const std::string text = certificate->subject + " (" + Listed(certificate->names) + "), valid from " +
                           Date(certificate->not_before_s) + " to " + Date(certificate->not_after_s);
  if (now_s > certificate->not_after_s) return {Level::kFail, subject, text, "It has expired: renew it."};
  if (now_s < certificate->not_before_s) {
    return {Level::kFail, subject, text, "It is not valid yet: check the clock, or wait."};
  }
  if (!host.empty() && !IsCertificateFor(pem, host)) {
    return {Level::kFail, subject, text, "It is not for " + host + ": call the server by one of its names."};
  }
  constexpr int64_t kSoon_s = 14 * 86400;
  if (certificate->not_after_s - now_s < kSoon_s) return {Level::kWarn, subject, text, "It expires soon: renew it."};
  return {Level::kOk, subject, text, ""};
}

}  // namespace rollgait::client
