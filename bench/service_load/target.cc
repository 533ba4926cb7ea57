#include "bench/service_load/target.h"

#include <chrono>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "tests/support/certificates.h"

namespace rollgait::load {
namespace {

std::string FirstLine(const std::string& path, const char* flag) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line))
    throw std::runtime_error(std::string(flag) + " " + path + ": cannot read a line of it");
  return line;
}

std::string WholeFile(const std::string& path, const char* flag) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(std::string(flag) + " " + path + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

int64_t ResidentBytes(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  int64_t size = 0, resident = 0;
  file >> size >> resident;
  return resident * 4096;
}

}  // namespace

Target::Target(const TargetOptions& options) : address_(options.address) {
  if (!options.token_file.empty()) token_ = FirstLine(options.token_file, "--token-file");
  if (!options.tls_ca.empty()) authority_ = WholeFile(options.tls_ca, "--tls-ca");
  if (address_.empty()) Start(options);
  credentials_ = authority_.empty() ? grpc::InsecureChannelCredentials() : grpc::SslCredentials({authority_, "", ""});
}

void Target::Start(const TargetOptions& options) {
  server::Daemon::Options daemon;
  daemon.data_dir = directory_.path() + "/data";
  daemon.solver = options.solver;
  daemon.flags = {"--solver-slots", std::to_string(options.solver_slots), "--log-level", "warning"};
  if (!options.plain_text) {
    const Identity authority = MakeAuthority("service_load"), identity = MakeCertificate(authority, "localhost");
    authority_ = authority.cert;
    const std::string cert = directory_.path() + "/server.pem", key = directory_.path() + "/server.key";
    WriteFileAtOnce(cert, identity.cert);
    WriteFileAtOnce(key, identity.key);
    daemon.flags.insert(daemon.flags.end(), {"--tls-cert", cert, "--tls-key", key, "--require-token"});
  }
  daemon.flags.insert(daemon.flags.end(), options.flags.begin(), options.flags.end());
  daemon_ = std::make_unique<server::Daemon>(daemon);
  address_ = daemon_->address();
  if (address_.empty()) throw std::runtime_error("rollgaitd did not start; its reason is above");
  if (options.plain_text) return;
  token_ =
      server::OutputOfRollgaitd("token create --data-dir " + daemon.data_dir + " --tenant load --scopes read,solve");
}

std::shared_ptr<grpc::Channel> Target::Open(Windows windows) const {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetMaxReceiveMessageSize(-1);
  if (windows == Windows::kFixed) arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  std::shared_ptr<grpc::Channel> channel = grpc::CreateCustomChannel(address_, credentials_, arguments);
  if (!channel->WaitForConnected(std::chrono::system_clock::now() + std::chrono::seconds(20))) {
    throw std::runtime_error("no connection to " + address_ + " within 20 s");
  }
  return channel;
}

std::unique_ptr<Stub> Target::Connect(Windows windows) const { return v1::GaitService::NewStub(Open(windows)); }

std::vector<std::unique_ptr<Stub>> Target::Connect(int count, Windows windows) const {
  std::vector<std::unique_ptr<Stub>> stubs;
  for (int i = 0; i < count; ++i) stubs.push_back(Connect(windows));
  return stubs;
}

void Target::Authorize(grpc::ClientContext& context) const {
  if (!token_.empty()) context.AddMetadata("authorization", "Bearer " + token_);
}

int64_t Target::ServerMemory() const { return daemon_ == nullptr ? 0 : ResidentBytes(daemon_->pid()); }

BusySlots::BusySlots(const Target& target, int slots) : target_(target), stub_(target.Connect()) {
  for (int i = 0; i < slots; ++i) {
    v1::CreateSolveRequest request;
    request.mutable_spec()->mutable_model()->set_name("human29");
    request.mutable_spec()->set_starts(32);
    request.mutable_spec()->set_slope_rad(0.001 * (1 + i));
    grpc::ClientContext context;
    target.Authorize(context);
    v1::Solve solve;
    const grpc::Status status = stub_->CreateSolve(&context, request, &solve);
    if (!status.ok()) throw std::runtime_error("a solve for the cores cannot be created: " + status.error_message());
    names_.push_back(solve.name());
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!StillBusy()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("the slots were not taken within 60 s");
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

BusySlots::~BusySlots() {
  for (const std::string& name : names_) {
    grpc::ClientContext context;
    target_.Authorize(context);
    v1::CancelSolveRequest request;
    request.set_name(name);
    v1::Solve solve;
    stub_->CancelSolve(&context, request, &solve);
  }
}

bool BusySlots::StillBusy() {
  for (const std::string& name : names_) {
    grpc::ClientContext context;
    target_.Authorize(context);
    v1::GetSolveRequest request;
    request.set_name(name);
    v1::Solve solve;
    if (!stub_->GetSolve(&context, request, &solve).ok() || solve.state() != v1::SOLVE_STATE_RUNNING) return false;
  }
  return true;
}

MemoryWatch::MemoryWatch(const Target& target) : target_(target) {
  thread_ = std::thread([this] {
    while (!stopping_) {
      samples_.push_back(target_.ServerMemory());
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
}

MemoryWatch::~MemoryWatch() { Stop(); }

void MemoryWatch::Stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

int64_t MemoryWatch::Growth() {
  Stop();
  const size_t quarter = samples_.size() / 4;
  if (quarter == 0) return 0;
  int64_t early = 0, late = 0;
  for (size_t i = 0; i < quarter; ++i) {
    early += samples_[quarter + i];
    late += samples_[samples_.size() - 1 - i];
  }
  return (late - early) / static_cast<int64_t>(quarter);
}

int64_t MemoryWatch::Largest() {
  Stop();
  int64_t largest = 0;
  for (const int64_t sample : samples_) largest = std::max(largest, sample);
  return largest;
}

}  // namespace rollgait::load
