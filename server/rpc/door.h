#ifndef ROLLGAIT_SERVER_RPC_DOOR_H_
#define ROLLGAIT_SERVER_RPC_DOOR_H_

#include <grpcpp/grpcpp.h>

#include <map>
#include <string>

#include "server/base/door_headers.h"
#include "server/base/outcome.h"
#include "server/rpc/call_identity.h"

namespace rollgait::server {

// The door is the proxy that ends TLS and HTTP/2 for a server: docs/explanation/door.md. Over a unix socket it tells
// the server, in the metadata of server/base/door_headers.h, what it knows of a client. A server without a door does
// not read them.
using CallMetadata = std::multimap<grpc::string_ref, grpc::string_ref>;

// The client's address as the door states it. kFailedPrecondition unless it is stated exactly once, in at most 128
// printable characters.
Outcome<std::string> PeerBehindDoor(const CallMetadata& metadata);

// The name in the certificate that the door has verified; empty without a certificate, and where the name is not there
// exactly once, as with certificates that gRPC itself verifies. kFailedPrecondition: what the door sent is none.
Outcome<std::string> CertificateNameBehindDoor(const CallMetadata& metadata, CertificateTenant kind);

// The client's address for logs: the door's word if the call has a record, else the connection's.
std::string PeerOf(const grpc::ServerContextBase& context);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_DOOR_H_
