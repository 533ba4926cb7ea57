#include "server/listen_main.h"

#include <CLI/CLI.hpp>

#include "server/base/listen_address.h"

namespace rollgait::server {

void AddListenFlags(CLI::App& app, ListenFlags& flags) {
  app.add_option("--listen", flags.address,
                 "HOST:PORT, port 0: any free one; or unix:PATH; printed as `rollgaitd listening on ...`")
      ->capture_default_str();
  auto* behind =
      app.add_flag("--behind-door", flags.behind_door,
                   "The door of docs/explanation/door.md is in front and alone may reach --listen unix:PATH; it "
                   "says who calls");
  app.add_flag("--without-door", flags.without_door,
               "Allow --listen beyond the loopback interface without a door in front; any peer can then use up memory")
      ->excludes(behind);
  app.add_flag("--insecure-listen", flags.insecure, "Allow plain text beyond the loopback interface");
}

std::optional<std::string> ListenObstacle(const ListenFlags& flags, const AccessFlags& access) {
  const bool has_certificate = !access.tls.cert.empty();
  if (flags.behind_door && flags.address.rfind("unix:/", 0) != 0) {
    return "--behind-door needs --listen unix:/PATH, a socket that only the door can reach; --listen is " +
           flags.address;
  }
  if (flags.behind_door && has_certificate) {
    return "behind a door it is the door that speaks TLS: give the certificate, the key and the authority of clients "
           "to the door (docs/explanation/door.md) and omit --tls-cert, --tls-key and --tls-client-ca";
  }
  if (access.certificate_tenant != CertificateTenant::kNone && access.tls.client_ca.empty() && !flags.behind_door) {
    return "--certificate-tenant needs certificates of clients: give --tls-client-ca, or --behind-door where the door "
           "asks for them";
  }
  if (IsLoopback(flags.address)) return std::nullopt;
  if (!flags.without_door) {
    return "--listen " + flags.address + " is not a loopback address, and there any peer could use up the memory of " +
           "this server before it shows a token (docs/explanation/door.md). Let the door listen there and give " +
           "--listen unix:/run/rollgait/door.sock --behind-door, or say --without-door";
  }
  if (!has_certificate && !flags.insecure) {
    return "--listen " + flags.address + " is not a loopback address and this server speaks plain text: anyone on " +
           "the network could read and use it. Give --tls-cert and --tls-key, listen on 127.0.0.1, or say " +
           "--insecure-listen";
  }
  return std::nullopt;
}

}  // namespace rollgait::server
