// Races on purpose: what support/thread_reports must find. Both programs end with 0 themselves.
//   planted_race child    in a program that is started and killed
//   planted_race handler  in what threads of gRPC call
#include <grpcpp/grpcpp.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "rollgait/v1/gait_service.grpc.pb.h"

extern char** environ;

namespace {

int unguarded = 0;

void Count() {
  for (int i = 0; i < 100; ++i) {
    ++unguarded;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void Race() {
  std::thread one(Count), other(Count);
  one.join();
  other.join();
}

int KillChild(std::string program) {
  std::string argument = "race";
  char* arguments[] = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  if (posix_spawn(&pid, program.c_str(), nullptr, nullptr, arguments, environ) != 0) return 1;
  std::this_thread::sleep_for(std::chrono::seconds(2));
  kill(pid, SIGKILL);
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFSIGNALED(status) ? 0 : 1;
}

class RacingService final : public rollgait::v1::GaitService::Service {
  grpc::Status GetServerInfo(grpc::ServerContext*, const rollgait::v1::GetServerInfoRequest*,
                             rollgait::v1::ServerInfo*) override {
    Count();
    return grpc::Status::OK;
  }
};

int CallTwice() {
  RacingService service;
  grpc::ServerBuilder builder;
  int port = 0;
  builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(), &port);
  builder.RegisterService(&service);
  const std::unique_ptr<grpc::Server> server = builder.BuildAndStart();
  const auto call = [port] {
    const auto stub = rollgait::v1::GaitService::NewStub(
        grpc::CreateChannel("127.0.0.1:" + std::to_string(port), grpc::InsecureChannelCredentials()));
    grpc::ClientContext context;
    rollgait::v1::ServerInfo answer;
    stub->GetServerInfo(&context, {}, &answer);
  };
  std::thread one(call), other(call);
  one.join();
  other.join();
  server->Shutdown();
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  const std::string place = count > 1 ? arguments[1] : "";
  if (place == "child") return KillChild(arguments[0]);
  if (place == "handler") return CallTwice();
  Race();
  pause();
}
