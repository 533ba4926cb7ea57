#ifndef ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_
#define ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_

#include <grpcpp/grpcpp.h>

#include "server/access/gatekeeper.h"

namespace rollgait::server {

// Which name in a client's certificate is its tenant's.
enum class CertificateTenant { kNone, kCommonName, kUri };

// What a call shows of where it comes from. A certificate counts only if TLS has verified it.
Presented ReadIdentity(const grpc::CallbackServerContext& context, CertificateTenant certificate_tenant);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_CALL_IDENTITY_H_
