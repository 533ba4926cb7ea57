#include "server/gateway/upstream.h"

#include <grpcpp/create_channel.h>
#include <grpcpp/generic/generic_stub.h>

#include <algorithm>
#include <mutex>

#include "server/base/door_headers.h"

namespace rollgait::server {
namespace {

// gRPC ends the program at a value that its transport cannot carry. Which header has one; empty: none.
std::string UnfitMetadata(const UpstreamCall::Request& request) {
  const auto unfit = [](char byte) { return byte < ' ' || byte > '~'; };
  for (const auto& [name, value] : request.metadata) {
    if (std::any_of(value.begin(), value.end(), unfit)) return name;
  }
  return "";
}

// A call that was not begun.
class NoCall final : public UpstreamCall {
 public:
  void ReadNext() override {}
  void Cancel() override {}
};

std::string Text(const grpc::ByteBuffer& buffer) {
  std::vector<grpc::Slice> slices;
  std::string text;
  if (!buffer.Dump(&slices).ok()) return text;
  text.reserve(buffer.Length());
  for (const grpc::Slice& slice : slices) text.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return text;
}

// Lives until gRPC is done with it, whoever else holds it.
class Call final : public UpstreamCall, public grpc::ClientBidiReactor<grpc::ByteBuffer, grpc::ByteBuffer> {
 public:
  Call(const std::shared_ptr<grpc::Channel>& channel, const Request& request, Listener listener)
      : stub_(channel), listener_(std::move(listener)) {
    const grpc::Slice slice(request.message);
    request_ = grpc::ByteBuffer(&slice, 1);
    for (const auto& [name, value] : request.metadata) context_.AddMetadata(name, value);
    context_.set_deadline(std::chrono::system_clock::now() + request.deadline);
    method_ = request.method;
  }

  void Begin(std::shared_ptr<Call> self) {
    self_ = std::move(self);
    stub_.PrepareBidiStreamingCall(&context_, method_, grpc::StubOptions(), this);
    AddHold();  // reads are begun by other threads than reactions
    StartWriteLast(&request_, grpc::WriteOptions());
    StartRead(&answer_);
    StartCall();
  }

  void ReadNext() override {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (held_) StartRead(&answer_);
  }

  void Cancel() override {
    context_.TryCancel();
    Release();  // a reader who waits to be asked would wait for ever
  }

  void OnReadDone(bool ok) override {
    if (!ok) return Release();
    std::string message = Text(answer_);
    answer_.Clear();
    listener_.on_message(std::move(message));
  }

  void OnDone(const grpc::Status& status) override {
    CallEnd end{status, context_.GetServerInitialMetadata().count(kDoorRefused) > 0 ||
                            context_.GetServerTrailingMetadata().count(kDoorRefused) > 0};
    listener_.on_end(end);
    listener_ = {};
    const std::shared_ptr<Call> last = std::move(self_);
  }

 private:
  void Release() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!std::exchange(held_, false)) return;
    }
    RemoveHold();
  }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  std::string method_;
  grpc::ByteBuffer request_, answer_;
  Listener listener_;
  std::shared_ptr<Call> self_;
  std::mutex mutex_;
  bool held_ = true;
};

}  // namespace

std::shared_ptr<UpstreamCall> UpstreamCall::Start(const std::shared_ptr<grpc::Channel>& channel, const Request& request,
                                                  Listener listener) {
  if (const std::string name = UnfitMetadata(request); !name.empty()) {
    listener.on_end({{grpc::StatusCode::INVALID_ARGUMENT,
                      "the header " + name + " has bytes that are no printable ASCII, which calls cannot carry"}});
    return std::make_shared<NoCall>();
  }
  const auto call = std::make_shared<Call>(channel, request, std::move(listener));
  call->Begin(call);
  return call;
}

Upstream::Upstream(std::string server) : server_(std::move(server)), channel_(MakeChannel()) {}

std::shared_ptr<grpc::Channel> Upstream::MakeChannel() const {
  grpc::ChannelArguments arguments;
  arguments.SetMaxReceiveMessageSize(-1);
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_ENABLE_HTTP_PROXY, 0);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 100);
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 500);
  arguments.SetUserAgentPrefix("rollgait-gateway");
  return grpc::CreateCustomChannel(server_, grpc::InsecureChannelCredentials(), arguments);
}

}  // namespace rollgait::server
