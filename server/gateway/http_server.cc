#include "server/gateway/http_server.h"

#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <functional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "server/gateway/mhd_exchange.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;
using Clock = MhdExchange::Clock;

constexpr milliseconds kTick{250};

// A connection, with the request that is under way on it.
struct Peer {
  int fd = -1;
  Clock::time_point deadline;  // of the next request
  std::shared_ptr<MhdExchange> exchange;
};

class MhdServer final : public HttpServer {
 public:
  MhdServer(const HttpLimits& limits, HttpHandler handler) : limits_(limits), handler_(std::move(handler)) {}

  Outcome<Done> Open(const std::string& listen) {
    const Outcome<int> fd = OpenListener(listen, &address_);
    if (!fd.ok()) return fd.error();
    daemon_ = MHD_start_daemon(MHD_USE_POLL | MHD_USE_INTERNAL_POLLING_THREAD | MHD_ALLOW_SUSPEND_RESUME | MHD_USE_ITC,
                               0, nullptr, nullptr, &OnData, this, MHD_OPTION_LISTEN_SOCKET, fd.value(),
                               MHD_OPTION_CONNECTION_LIMIT, limits_.connections, MHD_OPTION_PER_IP_CONNECTION_LIMIT,
                               limits_.connections_per_peer, MHD_OPTION_CONNECTION_MEMORY_LIMIT,
                               limits_.connection_memory, MHD_OPTION_STRICT_FOR_CLIENT, 1, MHD_OPTION_URI_LOG_CALLBACK,
                               &OnUri, this, MHD_OPTION_NOTIFY_COMPLETED, &OnCompleted, this,
                               MHD_OPTION_NOTIFY_CONNECTION, &OnConnection, this, MHD_OPTION_END);
    if (daemon_ == nullptr) {
      close(fd.value());
      return Error{ErrorCode::kUnavailable, "cannot serve HTTP on " + listen + ": libmicrohttpd does not start"};
    }
    ticker_ = std::thread([this] { Tick(); });
    return Done{};
  }

  ~MhdServer() override { Stop(milliseconds(0)); }

  const std::string& address() const override { return address_; }

  void Stop(milliseconds grace) override {
    if (daemon_ == nullptr) return;
    const int listener = MHD_quiesce_daemon(daemon_);
    if (listener >= 0) close(listener);
    Close([](const Peer& peer) { return peer.exchange == nullptr || !peer.exchange->IsUnderWay(); });
    for (const auto& exchange : Exchanges()) exchange->OnStop();
    for (const auto end = Clock::now() + grace; Clock::now() < end && !Exchanges().empty();) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    // The library must not be stopped while connections are suspended.
    while (!Exchanges().empty()) {
      Close([](const Peer&) { return true; });
      std::this_thread::sleep_for(milliseconds(5));
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_all();
    ticker_.join();
    MHD_stop_daemon(std::exchange(daemon_, nullptr));
    if (address_.rfind("unix:", 0) == 0) unlink(address_.c_str() + 5);
  }

 private:
  static MHD_Result OnData(void* server, MHD_Connection* connection, const char*, const char* verb, const char*,
                           const char* data, size_t* size, void** exchange) {
    if (*exchange == nullptr) return MHD_NO;
    return static_cast<MhdExchange*>(*exchange)->OnData(connection, verb, data, size,
                                                        static_cast<MhdServer*>(server)->handler_);
  }

  // The first line of a request is here. What is returned comes back as `exchange`; the peer keeps it alive.
  static void* OnUri(void* server, const char* uri, MHD_Connection* connection) {
    auto& self = *static_cast<MhdServer*>(server);
    Peer* const peer = PeerOf(connection);
    if (peer == nullptr) return nullptr;
    auto exchange = std::make_shared<MhdExchange>(self.limits_, self.long_bodies_, uri);
    const std::lock_guard<std::mutex> lock(self.mutex_);
    peer->exchange = std::move(exchange);
    return peer->exchange.get();
  }

  static void OnCompleted(void* server, MHD_Connection* connection, void**, MHD_RequestTerminationCode) {
    auto& self = *static_cast<MhdServer*>(server);
    Peer* const peer = PeerOf(connection);
    if (peer == nullptr) return;
    std::shared_ptr<MhdExchange> exchange;
    {
      const std::lock_guard<std::mutex> lock(self.mutex_);
      exchange = std::exchange(peer->exchange, nullptr);
      peer->deadline = Clock::now() + self.limits_.head_time;
    }
    if (exchange != nullptr) exchange->OnCompleted();
  }

  static void OnConnection(void* server, MHD_Connection* connection, void** context,
                           MHD_ConnectionNotificationCode what) {
    auto& self = *static_cast<MhdServer*>(server);
    const std::lock_guard<std::mutex> lock(self.mutex_);
    if (what == MHD_CONNECTION_NOTIFY_STARTED) {
      const auto* info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_CONNECTION_FD);
      auto peer = std::make_unique<Peer>();
      peer->fd = info == nullptr ? -1 : info->connect_fd;
      peer->deadline = Clock::now() + self.limits_.head_time;
      *context = peer.get();
      self.peers_.insert(std::move(peer));
    } else {
      const auto* const peer = static_cast<Peer*>(*context);
      std::erase_if(self.peers_, [&](const auto& one) { return one.get() == peer; });
      *context = nullptr;
    }
  }

  static Peer* PeerOf(MHD_Connection* connection) {
    const auto* info = MHD_get_connection_info(connection, MHD_CONNECTION_INFO_SOCKET_CONTEXT);
    return info == nullptr ? nullptr : static_cast<Peer*>(info->socket_context);
  }

  std::vector<std::shared_ptr<MhdExchange>> Exchanges() {
    std::vector<std::shared_ptr<MhdExchange>> exchanges;
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& peer : peers_) {
      if (peer->exchange != nullptr) exchanges.push_back(peer->exchange);
    }
    return exchanges;
  }

  // Closes connections that take too long: libmicrohttpd's own timeouts begin anew with every byte.
  void Tick() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kTick, [this] { return stopping_; })) {
      std::vector<std::shared_ptr<MhdExchange>> late;
      lock.unlock();
      for (const auto& exchange : Exchanges()) {
        if (exchange->OnTick(Clock::now())) late.push_back(exchange);
      }
      Close([&](const Peer& peer) {
        return peer.exchange == nullptr ? Clock::now() > peer.deadline
                                        : std::find(late.begin(), late.end(), peer.exchange) != late.end();
      });
      lock.lock();
    }
  }

  // Ends connections, whatever their peers do: the library sees their end when it reads or writes next.
  void Close(const std::function<bool(const Peer&)>& which) {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& peer : peers_) {
      if (!which(*peer)) continue;
      shutdown(peer->fd, SHUT_RDWR);
      if (peer->exchange != nullptr) peer->exchange->Abort();
    }
  }

  const HttpLimits limits_;
  const HttpHandler handler_;
  std::string address_;
  const std::shared_ptr<std::atomic<int>> long_bodies_ = std::make_shared<std::atomic<int>>(0);
  MHD_Daemon* daemon_ = nullptr;
  std::mutex mutex_;  // protects what follows
  std::condition_variable wake_;
  std::set<std::unique_ptr<Peer>> peers_;
  bool stopping_ = false;
  std::thread ticker_;
};

}  // namespace

Outcome<std::unique_ptr<HttpServer>> HttpServer::Start(const std::string& listen, const HttpLimits& limits,
                                                       HttpHandler handler) {
  auto server = std::make_unique<MhdServer>(limits, std::move(handler));
  if (const Outcome<Done> opened = server->Open(listen); !opened.ok()) return opened.error();
  return std::unique_ptr<HttpServer>(std::move(server));
}

}  // namespace rollgait::server
