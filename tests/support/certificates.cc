#include "tests/support/certificates.h"

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <cstdio>
#include <fstream>
#include <memory>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Key = std::unique_ptr<EVP_PKEY, decltype(&EVP_PKEY_free)>;
using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;
using Memory = std::unique_ptr<BIO, decltype(&BIO_free)>;

std::string Text(BIO* memory) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(memory, &bytes);
  return {bytes, static_cast<size_t>(size)};
}

void Extend(X509* certificate, X509* issuer, int kind, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* const extension = X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str());
  ROLLGAIT_CHECK(extension != nullptr && X509_add_ext(certificate, extension, -1) == 1);
  X509_EXTENSION_free(extension);
}

// `issuer` null: signs itself.
Identity Make(const std::string& name, long from_s, long until_s, X509* issuer, EVP_PKEY* issuer_key) {
  const Key key(EVP_EC_gen("P-256"), EVP_PKEY_free);
  const Certificate certificate(X509_new(), X509_free);
  X509* const made = certificate.get();
  X509_set_version(made, 2);
  uint32_t serial = 0;
  ROLLGAIT_CHECK(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof(serial)) == 1);
  ASN1_INTEGER_set(X509_get_serialNumber(made), static_cast<long>(serial >> 1));
  X509_gmtime_adj(X509_getm_notBefore(made), from_s);
  X509_gmtime_adj(X509_getm_notAfter(made), until_s);
  X509_set_pubkey(made, key.get());
  X509_NAME_add_entry_by_txt(X509_get_subject_name(made), "CN", MBSTRING_UTF8,
                             reinterpret_cast<const unsigned char*>(name.c_str()), -1, -1, 0);
  X509_set_issuer_name(made, X509_get_subject_name(issuer == nullptr ? made : issuer));
  Extend(made, made, NID_subject_key_identifier, "hash");
  if (issuer == nullptr) {
    Extend(made, made, NID_basic_constraints, "critical,CA:TRUE");
    Extend(made, made, NID_key_usage, "critical,keyCertSign,cRLSign");
  } else {
    Extend(made, issuer, NID_authority_key_identifier, "keyid");
    Extend(made, issuer, NID_key_usage, "critical,digitalSignature");
    Extend(made, issuer, NID_ext_key_usage, "serverAuth,clientAuth");
    Extend(made, issuer, NID_subject_alt_name, "DNS:" + name + ",DNS:localhost,IP:127.0.0.1,URI:urn:rollgait:" + name);
  }
  ROLLGAIT_CHECK(X509_sign(made, issuer == nullptr ? key.get() : issuer_key, EVP_sha256()) > 0);
  const Memory cert_text(BIO_new(BIO_s_mem()), BIO_free), key_text(BIO_new(BIO_s_mem()), BIO_free);
  PEM_write_bio_X509(cert_text.get(), made);
  PEM_write_bio_PrivateKey(key_text.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr);
  return {Text(cert_text.get()), Text(key_text.get())};
}

Memory View(const std::string& text) {
  return Memory(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), BIO_free);
}

}  // namespace

Identity MakeAuthority(const std::string& name) { return Make(name, -86'400, 315'360'000, nullptr, nullptr); }

Identity MakeCertificate(const Identity& authority, const std::string& name, long from_s, long until_s) {
  const Certificate issuer(PEM_read_bio_X509(View(authority.cert).get(), nullptr, nullptr, nullptr), X509_free);
  const Key key(PEM_read_bio_PrivateKey(View(authority.key).get(), nullptr, nullptr, nullptr), EVP_PKEY_free);
  return Make(name, from_s, until_s, issuer.get(), key.get());
}

void WriteFileAtOnce(const std::string& path, const std::string& text) {
  std::ofstream(path + ".new", std::ios::binary) << text;
  ROLLGAIT_CHECK(std::rename((path + ".new").c_str(), path.c_str()) == 0);
}

}  // namespace rollgait
