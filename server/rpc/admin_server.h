#ifndef ROLLGAIT_SERVER_RPC_ADMIN_SERVER_H_
#define ROLLGAIT_SERVER_RPC_ADMIN_SERVER_H_

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// What a gRPC server offers besides its own services; none of it asks for a token.
struct Discovery {
  bool health = false, reflection = false, channelz = false;
};

// Offers just this on the server that the builder makes next.
void SetDiscovery(grpc::ServerBuilder& builder, const Discovery& discovery);

// The administration socket: grpc.health.v1.Health, reflection and channelz for whoever may open DIRECTORY/admin.sock,
// which only the server's own user may (mode 0600).
class AdminServer {
 public:
  static constexpr char kSocket[] = "admin.sock";

  // kUnavailable with the reason.
  static Outcome<std::unique_ptr<AdminServer>> Start(const std::string& directory);
  ~AdminServer();
  AdminServer(const AdminServer&) = delete;
  AdminServer& operator=(const AdminServer&) = delete;

  // What health answers, for the server as a whole and for GaitService.
  void SetServing(bool serving);

 private:
  AdminServer(std::string path, int directory_fd) : path_(std::move(path)), directory_fd_(directory_fd) {}

  const std::string path_;
  const int directory_fd_;
  std::unique_ptr<grpc::Server> server_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_RPC_ADMIN_SERVER_H_
