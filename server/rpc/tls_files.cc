#include "server/rpc/tls_files.h"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <vector>

namespace rollgait::server {
namespace {

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Memory = std::unique_ptr<BIO, decltype(&BIO_free)>;

Error Refuse(const char* flag, const std::string& path, const std::string& reason) {
  ERR_clear_error();
  return {ErrorCode::kInvalidArgument, std::string(flag) + " " + path + ": " + reason};
}

Outcome<std::string> Read(const char* flag, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file.is_open() || file.bad()) return Refuse(flag, path, std::string("cannot be read: ") + std::strerror(errno));
  if (text.empty()) return Refuse(flag, path, "is empty");
  return text;
}

Memory View(const std::string& text) { return {BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free}; }

std::vector<Certificate> Certificates(const std::string& pem) {
  const Memory memory = View(pem);
  std::vector<Certificate> all;
  while (X509* next = PEM_read_bio_X509(memory.get(), nullptr, nullptr, nullptr)) all.emplace_back(next, X509_free);
  return all;
}

int NoPassphrase(char*, int, int, void*) { return -1; }

std::string TimeText(const ASN1_TIME* time) {
  const Memory memory(BIO_new(BIO_s_mem()), BIO_free);
  ASN1_TIME_print(memory.get(), time);
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory.get(), &bytes);
  return {bytes, static_cast<size_t>(size)};
}

}  // namespace

Outcome<TlsMaterial> ReadTlsFiles(const TlsFiles& files) {
  TlsMaterial material;
  Outcome<std::string> cert = Read("--tls-cert", files.cert);
  if (!cert.ok()) return cert.error();
  Outcome<std::string> key = Read("--tls-key", files.key);
  if (!key.ok()) return key.error();
  material.cert = std::move(cert).value();
  material.key = std::move(key).value();
  const std::vector<Certificate> chain = Certificates(material.cert);
  if (chain.empty()) return Refuse("--tls-cert", files.cert, "holds no certificate in PEM form");
  const Key parsed(PEM_read_bio_PrivateKey(View(material.key).get(), nullptr, NoPassphrase, nullptr), EVP_PKEY_free);
  if (parsed == nullptr) return Refuse("--tls-key", files.key, "holds no private key in PEM form without a passphrase");
  if (X509_check_private_key(chain.front().get(), parsed.get()) != 1) {
    return Refuse("--tls-key", files.key, "does not belong to the first certificate of --tls-cert " + files.cert);
  }
  const ASN1_TIME* const from = X509_get0_notBefore(chain.front().get());
  const ASN1_TIME* const until = X509_get0_notAfter(chain.front().get());
  if (X509_cmp_current_time(until) < 0)
    return Refuse("--tls-cert", files.cert, "expired on " + TimeText(until) + "; renew it");
  if (X509_cmp_current_time(from) > 0) {
    return Refuse("--tls-cert", files.cert,
                  "is valid from " + TimeText(from) + " only; is this machine's clock right?");
  }
  if (!files.client_ca.empty()) {
    Outcome<std::string> ca = Read("--tls-client-ca", files.client_ca);
    if (!ca.ok()) return ca.error();
    material.client_ca = std::move(ca).value();
    if (Certificates(material.client_ca).empty()) {
      return Refuse("--tls-client-ca", files.client_ca, "holds no certificate in PEM form");
    }
  }
  ERR_clear_error();
  return material;
}

std::string TlsFilesVersion(const TlsFiles& files) {
  std::ostringstream version;
  for (const std::string* path : {&files.cert, &files.key, &files.client_ca}) {
    struct stat info {};
    if (path->empty() || stat(path->c_str(), &info) != 0) {
      version << "- ";
      continue;
    }
    version << info.st_dev << '.' << info.st_ino << '.' << info.st_size << '.' << info.st_mtim.tv_sec << '.'
            << info.st_mtim.tv_nsec << ' ';
  }
  return version.str();
}

}  // namespace rollgait::server
