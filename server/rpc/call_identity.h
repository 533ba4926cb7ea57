#ifndef ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_
#define ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_

#include <grpcpp/grpcpp.h>

#include "server/access/gatekeeper.h"
#include "server/base/outcome.h"

namespace rollgait::server {

// Which name in a client's certificate is its tenant's.
enum class CertificateTenant { kNone, kCommonName, kUri };

struct IdentitySource {
  CertificateTenant certificate_tenant = CertificateTenant::kNone;
  bool behind_door = false;  // the door has verified certificates and knows addresses
};

// What a call shows of where it comes from. A certificate counts only if TLS has verified it, here or at the door.
// kFailedPrecondition: the door does not say what it must.
Outcome<Presented> ReadIdentity(const grpc::CallbackServerContext& context, const IdentitySource& source);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_
