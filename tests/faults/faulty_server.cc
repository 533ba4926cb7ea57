#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/faults/faults.h"

namespace rollgait::faults {

FaultyServer::FaultyServer(server::Daemon::Options options) : options_(std::move(options)) {
  if (options_.data_dir.empty()) options_.data_dir = directory_.path() + "/data";
  options_.solver = SLOW_SOLVER;
  options_.flags.insert(options_.flags.end(), {"--solver-slots", "4", "--log-level", "error"});
  daemon_ = std::make_unique<server::Daemon>(options_);
  address_ = daemon_->address();
  if (address_.empty()) throw std::runtime_error("rollgaitd did not start");
  options_.listen = address_;
}

double FaultyServer::Restart() {
  past_.push_back(std::move(daemon_));
  const auto start = std::chrono::steady_clock::now();
  daemon_ = std::make_unique<server::Daemon>(options_);
  if (daemon_->address() != address_) throw std::runtime_error("rollgaitd did not start again on " + address_);
  SecondsToAnswer(address_);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double SecondsToAnswer(const std::string& address) {
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<Stub> stub = Connect(address);
  Await("an answer of " + address, [&] {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(2));
    v1::ServerInfo info;
    return stub->GetServerInfo(&context, {}, &info).ok();
  });
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Await(const std::string& what, const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("waited two minutes for " + what);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std::string SecondsText(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f s", seconds);
  return text;
}

}  // namespace rollgait::faults
