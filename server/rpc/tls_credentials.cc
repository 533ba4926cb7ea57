#include "server/rpc/tls_credentials.h"

#include <grpc/grpc.h>
#include <grpc/grpc_security.h>
#include <spdlog/spdlog.h>

#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace rollgait::server {
namespace {

// The files as gRPC asks for them, once a handshake.
class CertificateSource {
 public:
  CertificateSource(TlsFiles files, std::string version, TlsMaterial material)
      : files_(std::move(files)), version_(std::move(version)), fresh_(std::move(material)) {}

  grpc_ssl_certificate_config_reload_status Fetch(grpc_ssl_server_certificate_config** config) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::string now = TlsFilesVersion(files_);
    if (!fresh_ && now != version_) Reload(now);
    if (!fresh_) return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_UNCHANGED;
    const grpc_ssl_pem_key_cert_pair pair{fresh_->key.c_str(), fresh_->cert.c_str()};
    // gRPC wants roots even where it asks clients for nothing; then they are never looked at.
    const std::string& roots = fresh_->client_ca.empty() ? fresh_->cert : fresh_->client_ca;
    *config = grpc_ssl_server_certificate_config_create(roots.c_str(), &pair, 1);
    fresh_.reset();
    return GRPC_SSL_CERTIFICATE_CONFIG_RELOAD_NEW;
  }

 private:
  void Reload(const std::string& version) {
    version_ = version;
    Outcome<TlsMaterial> material = ReadTlsFiles(files_);
    if (material.ok()) {
      spdlog::info("the TLS certificate {} was replaced; new connections see it", files_.cert);
      fresh_ = std::move(material).value();
    } else {
      spdlog::error("the replaced TLS files are not taken, the former ones stay in use: {}", material.error().message);
    }
  }

  const TlsFiles files_;
  std::mutex mutex_;  // protects what follows
  std::string version_;
  std::optional<TlsMaterial> fresh_;  // not given to gRPC yet
};

grpc_ssl_certificate_config_reload_status FetchFrom(void* source, grpc_ssl_server_certificate_config** config) {
  return static_cast<CertificateSource*>(source)->Fetch(config);
}

// The C++ interface has no way to reload with a check of what is read; the C interface has.
class ReloadingCredentials final : public grpc::ServerCredentials {
 public:
  ReloadingCredentials(TlsFiles files, std::string version, TlsMaterial material)
      : with_clients_(!files.client_ca.empty()), source_(std::move(files), std::move(version), std::move(material)) {}

  void SetAuthMetadataProcessor(const std::shared_ptr<grpc::AuthMetadataProcessor>&) override {}  // handlers check

 private:
  int AddPortToServer(const std::string& address, grpc_server* server) override {
    grpc_server_credentials* const credentials =
        grpc_ssl_server_credentials_create_with_options(grpc_ssl_server_credentials_create_options_using_config_fetcher(
            with_clients_ ? GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY
                          : GRPC_SSL_DONT_REQUEST_CLIENT_CERTIFICATE,
            FetchFrom, &source_));
    const int port = grpc_server_add_http2_port(server, address.c_str(), credentials);
    grpc_server_credentials_release(credentials);
    return port;
  }

  const bool with_clients_;
  CertificateSource source_;
};

}  // namespace

Outcome<std::shared_ptr<grpc::ServerCredentials>> MakeTlsCredentials(const TlsFiles& files) {
  std::string version = TlsFilesVersion(files);
  Outcome<TlsMaterial> material = ReadTlsFiles(files);
  if (!material.ok()) return material.error();
  return std::shared_ptr<grpc::ServerCredentials>(
      std::make_shared<ReloadingCredentials>(files, std::move(version), std::move(material).value()));
}

}  // namespace rollgait::server
