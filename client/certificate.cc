#include "client/certificate.h"

#include <arpa/inet.h>
#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <ctime>
#include <memory>

namespace rollgait::client {
namespace {

using OwnedX509 = std::unique_ptr<X509, decltype(&X509_free)>;

OwnedX509 ParsePem(const std::string& pem) {
  const std::unique_ptr<BIO, decltype(&BIO_free)> bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())),
                                                      BIO_free);
  return {bio == nullptr ? nullptr : PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr), X509_free};
}

int64_t UnixSeconds(const ASN1_TIME* time) {
  std::tm utc{};
  return ASN1_TIME_to_tm(time, &utc) == 1 ? static_cast<int64_t>(timegm(&utc)) : 0;
}

std::string BytesOf(const ASN1_STRING* text) {
  return {reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)), static_cast<size_t>(ASN1_STRING_length(text))};
}

// "" for an address that is neither IPv4 nor IPv6.
std::string AddressText(const std::string& bytes) {
  char text[INET6_ADDRSTRLEN] = "";
  if (bytes.size() == 4) inet_ntop(AF_INET, bytes.data(), text, sizeof(text));
  if (bytes.size() == 16) inet_ntop(AF_INET6, bytes.data(), text, sizeof(text));
  return text;
}

std::vector<std::string> AlternativeNames(X509& certificate) {
  const std::unique_ptr<GENERAL_NAMES, decltype(&GENERAL_NAMES_free)> all(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)),
      GENERAL_NAMES_free);
  std::vector<std::string> names;
  for (int i = 0; all != nullptr && i < sk_GENERAL_NAME_num(all.get()); ++i) {
    const GENERAL_NAME* const name = sk_GENERAL_NAME_value(all.get(), i);
    std::string text;
    if (name->type == GEN_DNS) text = BytesOf(name->d.dNSName);
    if (name->type == GEN_IPADD) text = AddressText(BytesOf(name->d.iPAddress));
    if (!text.empty()) names.push_back(text);
  }
  return names;
}

}  // namespace

std::optional<Certificate> ReadCertificate(const std::string& pem) {
  const OwnedX509 x509 = ParsePem(pem);
  if (x509 == nullptr) return std::nullopt;
  Certificate certificate;
  X509_NAME* const subject = X509_get_subject_name(x509.get());
  const int at = X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
  if (at >= 0) certificate.subject = BytesOf(X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at)));
  certificate.names = AlternativeNames(*x509);
  certificate.not_before_s = UnixSeconds(X509_get0_notBefore(x509.get()));
  certificate.not_after_s = UnixSeconds(X509_get0_notAfter(x509.get()));
  return certificate;
}

bool IsCertificateFor(const std::string& pem, const std::string& host) {
  const OwnedX509 x509 = ParsePem(pem);
  if (x509 == nullptr) return false;
  return X509_check_host(x509.get(), host.data(), host.size(), 0, nullptr) == 1 ||
         X509_check_ip_asc(x509.get(), host.c_str(), 0) == 1;
}

}  // namespace rollgait::client
