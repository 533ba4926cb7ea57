#ifndef ROLLGAIT_SERVER_RPC_TLS_CREDENTIALS_H_
#define ROLLGAIT_SERVER_RPC_TLS_CREDENTIALS_H_

#include <grpcpp/security/server_credentials.h>

#include <memory>

#include "server/base/outcome.h"
#include "server/rpc/tls_files.h"

namespace rollgait::server {

// Credentials of a server with TLS 1.2 or later that looks at its files with every handshake: a connection made after
// they were replaced sees the new ones, those that exist go on. Files that became bad are not taken: the last good ones
// stay in use, and the log says so once. With a client CA every client must show a certificate that it signed.
// kInvalidArgument as ReadTlsFiles. Outlives every server that it is given to.
Outcome<std::shared_ptr<grpc::ServerCredentials>> MakeTlsCredentials(const TlsFiles& files);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_TLS_CREDENTIALS_H_
