#include "server/rpc/call_identity.h"

#include <grpc/grpc_security_constants.h>

#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/rpc/door.h"

namespace rollgait::server {

Outcome<Presented> ReadIdentity(const grpc::CallbackServerContext& context, const IdentitySource& source) {
  Presented presented;
  presented.peer = context.peer();
  const auto [first, last] = context.client_metadata().equal_range("authorization");
  // Two headers are ambiguous, and therefore not a token.
  if (first != last)
    presented.authorization = std::next(first) == last ? std::string(first->second.data(), first->second.size()) : "?";
  if (source.behind_door) {
    Outcome<std::string> peer = PeerBehindDoor(context.client_metadata());
    if (!peer.ok()) return peer.error();
    presented.peer = std::move(peer).value();
  }
  if (source.certificate_tenant == CertificateTenant::kNone) return presented;
  if (source.behind_door) {
    Outcome<std::string> name = CertificateNameBehindDoor(context.client_metadata(), source.certificate_tenant);
    if (!name.ok()) return name.error();
    presented.certificate_name = std::move(name).value();
    return presented;
  }
  const std::shared_ptr<const grpc::AuthContext> connection = context.auth_context();
  if (connection == nullptr || !connection->IsPeerAuthenticated()) return presented;
  const std::vector<grpc::string_ref> names = connection->FindPropertyValues(
      source.certificate_tenant == CertificateTenant::kUri ? GRPC_PEER_URI_PROPERTY_NAME : GRPC_X509_CN_PROPERTY_NAME);
  if (names.size() == 1) presented.certificate_name.assign(names[0].data(), names[0].size());
  return presented;
}

}  // namespace rollgait::server
