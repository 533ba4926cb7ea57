#include "server/rpc/door.h"

#include <openssl/evp.h>
#include <openssl/x509.h>
#include <openssl/x509v3.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "server/rpc/call_record.h"

namespace rollgait::server {
namespace {

constexpr size_t kMaxPeer = 128;  // "ipv6:[...]:port" has at most 58

Error Misconfigured(const std::string& what) {
  return {ErrorCode::kFailedPrecondition, "the door in front of this server " + what + "; its configuration must set " +
                                              kDoorPeer + " and " + kDoorCertificate +
                                              " as docker/door/haproxy.cfg does (docs/explanation/door.md)"};
}

// nullopt: not there exactly once. Empty: not there.
std::optional<std::string_view> Single(const CallMetadata& metadata, const char* name) {
  const auto [first, last] = metadata.equal_range(name);
  if (first == last) return std::string_view();
  if (std::next(first) != last) return std::nullopt;
  return std::string_view(first->second.data(), first->second.size());
}

using Certificate = std::unique_ptr<X509, decltype(&X509_free)>;

Certificate Decode(std::string_view base64) {
  Certificate none(nullptr, X509_free);
  if (base64.empty() || base64.size() % 4 != 0) return none;
  std::vector<unsigned char> der(base64.size() / 4 * 3);
  const int size = EVP_DecodeBlock(der.data(), reinterpret_cast<const unsigned char*>(base64.data()),
                                   static_cast<int>(base64.size()));
  if (size < 0) return none;
  const auto padding = std::count(base64.end() - 2, base64.end(), '=');
  const unsigned char* start = der.data();
  Certificate certificate(d2i_X509(nullptr, &start, size - padding), X509_free);
  return start == der.data() + size - padding ? std::move(certificate) : std::move(none);
}

std::string Text(const ASN1_STRING* text) {
  unsigned char* utf8 = nullptr;
  const int size = ASN1_STRING_to_UTF8(&utf8, text);
  if (size < 0) return {};
  std::string copy(reinterpret_cast<const char*>(utf8), static_cast<size_t>(size));
  OPENSSL_free(utf8);
  return copy;
}

std::vector<std::string> CommonNames(const X509& certificate) {
  std::vector<std::string> names;
  const X509_NAME* const subject = X509_get_subject_name(&certificate);
  for (int at = -1; (at = X509_NAME_get_index_by_NID(subject, NID_commonName, at)) >= 0;) {
    names.push_back(Text(X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at))));
  }
  return names;
}

std::vector<std::string> Uris(const X509& certificate) {
  std::vector<std::string> uris;
  const std::unique_ptr<GENERAL_NAMES, decltype(&GENERAL_NAMES_free)> names(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(&certificate, NID_subject_alt_name, nullptr, nullptr)),
      GENERAL_NAMES_free);
  for (int i = 0; i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* const name = sk_GENERAL_NAME_value(names.get(), i);
    if (name->type == GEN_URI) uris.push_back(Text(name->d.uniformResourceIdentifier));
  }
  return uris;
}

}  // namespace

Outcome<std::string> PeerBehindDoor(const CallMetadata& metadata) {
  const std::optional<std::string_view> peer = Single(metadata, kDoorPeer);
  const auto printable = [](char c) { return c > ' ' && c <= '~'; };
  if (!peer || peer->empty() || peer->size() > kMaxPeer || !std::all_of(peer->begin(), peer->end(), printable)) {
    return Misconfigured("does not state who calls");
  }
  return std::string(*peer);
}

Outcome<std::string> CertificateNameBehindDoor(const CallMetadata& metadata, CertificateTenant kind) {
  const std::optional<std::string_view> text = Single(metadata, kDoorCertificate);
  if (text && text->empty()) return std::string();
  const Certificate certificate = text ? Decode(*text) : Certificate(nullptr, X509_free);
  if (certificate == nullptr) return Misconfigured("states a certificate of the client that is none");
  const std::vector<std::string> names =
      kind == CertificateTenant::kUri ? Uris(*certificate) : CommonNames(*certificate);
  return names.size() == 1 ? names[0] : std::string();
}

std::string PeerOf(const grpc::ServerContextBase& context) {
  const std::shared_ptr<CallRecord> record = RecordOf(context);
  return record == nullptr ? context.peer() : record->origin().peer;
}

}  // namespace rollgait::server
