// The findings of `rollgait doctor`, each from what was measured: nothing here calls the server.
#ifndef ROLLGAIT_CLIENT_DIAGNOSIS_H_
#define ROLLGAIT_CLIENT_DIAGNOSIS_H_

#include <cstdint>
#include <string>

#include "client/connection.h"
#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::client {

struct Finding {
  enum class Level { kOk, kWarn, kFail };
  Level level = Level::kOk;
  std::string subject;  // "server certificate"
  std::string text;     // what was found
  std::string advice;   // what to do; empty where all is well
};

// The same version; warns of another major or minor one.
Finding JudgeVersion(const std::string& client_version, const v1::ServerInfo& info);

// Warns where the server's clock is more than 2 s, and half of the time that the call took, from ours.
//   sent_s, received_s  our clock around the call, s since 1970
Finding JudgeClock(const v1::ServerInfo& info, double sent_s, double received_s);

// Warns from 80 % of a full queue; fails where it is full.
Finding JudgeQueue(const v1::ServerInfo& info);

// Warns below 1 GiB, fails below 64 MiB, which is what a server keeps for solves that it has accepted.
Finding JudgeDisk(const v1::ServerInfo& info);

// Who the server takes us for; warns where solves cannot be asked for.
Finding JudgeCaller(const v1::ServerInfo& info);

// Fails for a certificate that cannot be read, has expired, is not valid yet, or is not for `host` (empty: not asked);
// warns in its last 14 days.
//   subject  "server certificate", "--tls-cert FILE"
Finding JudgeCertificate(const std::string& subject, const std::string& pem, const std::string& host, int64_t now_s);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_DIAGNOSIS_H_
