#include "server/rpc/admin_server.h"

#include <fcntl.h>
#include <grpcpp/ext/channelz_service_plugin.h>
#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/health_check_service_interface.h>
#include <grpcpp/impl/server_builder_option.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

#include "rollgait/v1/gait_service.grpc.pb.h"

namespace rollgait::server {
namespace {

// Plugins are registered for every server of a process; this keeps those that one server shall have.
class ChosenPlugins final : public grpc::ServerBuilderOption {
 public:
  explicit ChosenPlugins(const Discovery& discovery) : discovery_(discovery) {}
  void UpdateArguments(grpc::ChannelArguments*) override {}
  void UpdatePlugins(std::vector<std::unique_ptr<grpc::ServerBuilderPlugin>>* plugins) override {
    std::erase_if(*plugins, [this](const std::unique_ptr<grpc::ServerBuilderPlugin>& plugin) {
      return plugin->name() != "channelz_service" || !discovery_.channelz;
    });
    if (discovery_.reflection) plugins->push_back(std::make_unique<grpc::reflection::ProtoServerReflectionPlugin>());
  }

 private:
  const Discovery discovery_;
};

}  // namespace

void SetDiscovery(grpc::ServerBuilder& builder, const Discovery& discovery) {
  grpc::EnableDefaultHealthCheckService(discovery.health);
  builder.SetOption(std::make_unique<ChosenPlugins>(discovery));
}

Outcome<std::unique_ptr<AdminServer>> AdminServer::Start(const std::string& directory) {
  const std::string path = directory + "/" + kSocket;
  const auto refuse = [&](const std::string& reason) {
    return Error{ErrorCode::kUnavailable, "cannot make the administration socket " + path + ": " + reason};
  };
  const int directory_fd = open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (directory_fd < 0) return refuse(std::strerror(errno));
  std::unique_ptr<AdminServer> admin(new AdminServer(path, directory_fd));
  grpc::channelz::experimental::InitChannelzService();
  grpc::ServerBuilder builder;
  SetDiscovery(builder, {true, true, true});
  // Through /proc the address stays below the 108 bytes that the kernel takes. Nobody may connect before the mode is
  // set.
  const std::string address = "/proc/self/fd/" + std::to_string(directory_fd) + "/" + kSocket;
  const mode_t before = umask(0177);
  int bound = 0;
  builder.AddListeningPort("unix:" + address, grpc::InsecureServerCredentials(), &bound);
  admin->server_ = builder.BuildAndStart();
  umask(before);
  if (admin->server_ == nullptr || bound == 0) return refuse("it cannot be bound");
  if (chmod(path.c_str(), 0600) != 0) return refuse(std::strerror(errno));
  admin->SetServing(true);
  return admin;
}

AdminServer::~AdminServer() {
  if (server_ != nullptr) {
    server_->Shutdown(std::chrono::system_clock::now());
    server_.reset();
    unlink(path_.c_str());
  }
  close(directory_fd_);
}

void AdminServer::SetServing(bool serving) {
  server_->GetHealthCheckService()->SetServingStatus(serving);
  server_->GetHealthCheckService()->SetServingStatus(v1::GaitService::service_full_name(), serving);
}

}  // namespace rollgait::server
