#include "server/gateway/http_server.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <condition_variable>
#include <functional>
#include <optional>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "server/base/listen_socket.h"
#include "server/base/socket_file.h"
#include "server/gateway/mhd_exchange.h"
#include "server/gateway/problem.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;
using Clock = MhdExchange::Clock;

constexpr milliseconds kTick{250};
constexpr milliseconds kLastWords{300};  // for answers that say that the server stops

// A connection, with the request that is under way on it.
struct Peer {
  int fd = -1;
  std::string key;
  Clock::time_point deadline;  // of the next request
  std::shared_ptr<MhdExchange> exchange;
};

// The other side has closed, or will send nothing more, which counts as that. The library looks at no connection that
// is suspended.
bool HasLeft(int fd) {
  pollfd entry{fd, POLLRDHUP, 0};
  return poll(&entry, 1, 0) > 0;
}

bool IsIdle(const Peer& peer) { return peer.exchange == nullptr || !peer.exchange->IsUnderWay(); }

class MhdServer final : public HttpServer {
 public:
  MhdServer(const HttpLimits& limits, HttpService& service) : limits_(limits), service_(service) {}

  Outcome<Done> Open(const std::string& listen) {
    const Outcome<int> fd = Bind(listen);
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
    // While the socket still listens its file cannot be a successor's.
    if (file_.has_value()) file_->Remove();
    const int listener = MHD_quiesce_daemon(daemon_);
    if (listener >= 0) close(listener);
    WaitForAnswers(grace);
    for (const auto& exchange : Exchanges()) {
      exchange->SendProblem(503, grpc::StatusCode::UNAVAILABLE, "the gateway stops; ask again", 1);
    }
    WaitForAnswers(std::min(grace, kLastWords));
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
  }

 private:
  Outcome<int> Bind(const std::string& listen) {
    address_ = listen;
    if (listen.rfind("unix:", 0) == 0) {
      const std::string path = listen.substr(5);
      Outcome<int> fd = ListenOnUnix(path);
      if (fd.ok()) file_ = SocketFile::At(path);
      return fd;
    }
    Outcome<TcpListeners> listeners = ListenOnTcp(listen, 1);
    if (!listeners.ok()) return listeners.error();
    address_ = BoundAddress(listeners.value().fds[0]);
    return listeners.value().fds[0];
  }

  // At most so long. Whoever has no request on its way, or half of one, is closed.
  void WaitForAnswers(milliseconds at_most) {
    for (const auto end = Clock::now() + at_most; Clock::now() < end; std::this_thread::sleep_for(milliseconds(10))) {
      // All of them close before the first listener hears of the stop: what it does may let others answer.
      const auto exchanges = Exchanges();
      for (const auto& exchange : exchanges) exchange->CloseAfterAnswer();
      for (const auto& exchange : exchanges) exchange->OnStop();
      Close(IsIdle);
      if (Exchanges().empty()) return;
    }
  }

  static MHD_Result OnData(void* server, MHD_Connection* connection, const char*, const char* verb, const char*,
                           const char* data, size_t* size, void** exchange) {
    if (*exchange == nullptr) return MHD_NO;
    return static_cast<MhdExchange*>(*exchange)->OnData(connection, verb, data, size,
                                                        static_cast<MhdServer*>(server)->service_);
  }

  // The first line of a request is here. What is returned comes back as `exchange`; the peer keeps it alive.
  static void* OnUri(void* server, const char* uri, MHD_Connection* connection) {
    auto& self = *static_cast<MhdServer*>(server);
    Peer* const peer = PeerOf(connection);
    if (peer == nullptr) return nullptr;
    auto exchange = std::make_shared<MhdExchange>(self.limits_, uri, peer->key);
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
      sockaddr_storage address{};
      socklen_t size = sizeof address;
      if (getpeername(peer->fd, reinterpret_cast<sockaddr*>(&address), &size) == 0) peer->key = PeerKey(address);
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

  // Closes connections that take too long, because libmicrohttpd's own timeouts begin anew with every byte, and those
  // whose answer nobody waits for any more.
  void Tick() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (!wake_.wait_for(lock, kTick, [this] { return stopping_; })) {
      std::vector<std::shared_ptr<MhdExchange>> late;
      lock.unlock();
      for (const auto& exchange : Exchanges()) {
        if (exchange->OnTick(Clock::now())) late.push_back(exchange);
      }
      Close([&](const Peer& peer) {
        if (peer.exchange == nullptr) return Clock::now() > peer.deadline;
        return std::find(late.begin(), late.end(), peer.exchange) != late.end() ||
               (peer.exchange->IsSuspended() && HasLeft(peer.fd));
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
  HttpService& service_;
  std::string address_;
  std::optional<SocketFile> file_;
  MHD_Daemon* daemon_ = nullptr;
  std::mutex mutex_;  // protects what follows
  std::condition_variable wake_;
  std::set<std::unique_ptr<Peer>> peers_;
  bool stopping_ = false;
  std::thread ticker_;
};

}  // namespace

Outcome<std::unique_ptr<HttpServer>> HttpServer::Start(const std::string& listen, const HttpLimits& limits,
                                                       HttpService& service) {
  auto server = std::make_unique<MhdServer>(limits, service);
  if (const Outcome<Done> opened = server->Open(listen); !opened.ok()) return opened.error();
  return std::unique_ptr<HttpServer>(std::move(server));
}

}  // namespace rollgait::server
