#ifndef ROLLGAIT_SERVER_RPC_TLS_FILES_H_
#define ROLLGAIT_SERVER_RPC_TLS_FILES_H_

#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// PEM files of a server's identity, as flags name them.
struct TlsFiles {
  std::string cert;       // chain, the server's own first; empty: no TLS
  std::string key;        // of the first certificate, without a passphrase
  std::string client_ca;  // CA bundle (PEM) for clients; empty: clients show no certificate
};

// What the files hold.
struct TlsMaterial {
  std::string cert, key, client_ca;  // PEM
};

// Reads and checks: every file is PEM of its kind, the key belongs to the certificate, the certificate is valid now.
// kInvalidArgument names flag, file and reason.
Outcome<TlsMaterial> ReadTlsFiles(const TlsFiles& files);

// Differs whenever one of the files was written or replaced.
std::string TlsFilesVersion(const TlsFiles& files);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_TLS_FILES_H_
