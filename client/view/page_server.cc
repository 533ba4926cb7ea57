#include "client/view/page_server.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <filesystem>
#include <mutex>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "client/failure.h"
#include "client/report/report.h"
#include "client/view/http_library.h"

namespace rollgait::client {
namespace {

using std::chrono::milliseconds;

constexpr int kWorkers = 8;     // connections that are served at once
constexpr size_t kWaiting = 8;  // accepted ones that wait for one of them; further ones wait in the kernel
constexpr int kStreams = 4;
constexpr milliseconds kPatience{2000};  // after which an idle stream says that it is there
constexpr milliseconds kBreath{100};     // between what a stream says
constexpr int kTimeout_s = 5;            // for a request to come and for an answer to be taken
constexpr size_t kPiece = 65536;         // bytes of the page that are handed over at once

// 128 random bits as hexadecimal digits.
std::string RandomToken() {
  std::array<unsigned char, 16> bytes;
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw Failure(ExitCode::kInternal, "the kernel gives no random bytes");
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    token += "0123456789abcdef"[byte >> 4];
    token += "0123456789abcdef"[byte & 15];
  }
  return token;
}

// Workers with a queue that is full at some time: whoever accepts connections waits then.
class BoundedQueue : public httplib::TaskQueue {
 public:
  BoundedQueue() {
    for (int i = 0; i < kWorkers; ++i) threads_.emplace_back([this] { Work(); });
  }

  // Of void or bool, with the version of the library.
  using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue(std::function<void()>()));
  Enqueued enqueue(std::function<void()> job) override {
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return jobs_.size() < kWaiting || ends_; });
      jobs_.push_back(std::move(job));
    }
    changed_.notify_all();
    return Enqueued(true);
  }

  void shutdown() override {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ends_ = true;
    }
    changed_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

 private:
  // What is queued is done to its end: a job owns its connection.
  void Work() {
    while (true) {
      std::function<void()> job;
      {
        std::unique_lock<std::mutex> lock(mutex_);
        changed_.wait(lock, [this] { return !jobs_.empty() || ends_; });
        if (jobs_.empty()) return;
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      changed_.notify_all();
      job();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> jobs_;
  bool ends_ = false;
  std::vector<std::thread> threads_;
};

// The library shares the port with whoever asks (SO_REUSEPORT) unless it is told not to.
void KeepPort(int socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

// Ends the connections of this process to 127.0.0.1:port, whatever a thread is waiting for on them: the library waits
// for each byte anew, and does not tell which connections it has accepted. Without /proc they end when their peers let
// them.
void EndConnections(int port) {
  std::error_code failure;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string name = entry->path().filename().string();
    int number = -1;
    std::from_chars(name.data(), name.data() + name.size(), number);
    const int socket = fcntl(number, F_DUPFD_CLOEXEC, 0);  // stays what it is while its owner closes the number
    if (socket < 0) continue;
    sockaddr_in own{};
    socklen_t size = sizeof own;
    if (getsockname(socket, reinterpret_cast<sockaddr*>(&own), &size) == 0 && own.sin_family == AF_INET &&
        own.sin_addr.s_addr == htonl(INADDR_LOOPBACK) && ntohs(own.sin_port) == port) {
      shutdown(socket, SHUT_RDWR);
    }
    close(socket);
  }
}

void Refuse(httplib::Response& response, int status, const std::string& reason) {
  response.status = status;
  response.set_content(reason + "\n", "text/plain; charset=utf-8");
}

}  // namespace

class PageServer::Implementation {
 public:
  Implementation(int port, MakePage make_page, LiveFeed& feed)
      : make_page_(std::move(make_page)), feed_(feed), path_("/" + RandomToken() + "/") {
    server_.new_task_queue = [] { return new BoundedQueue; };
    server_.set_socket_options([](auto socket) { KeepPort(static_cast<int>(socket)); });
    server_.set_keep_alive_max_count(1);
    server_.set_read_timeout(kTimeout_s);
    server_.set_write_timeout(kTimeout_s);
    // Before the library looks for a handler, which it does with regular expressions.
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      Answer(request, response);
      return httplib::Server::HandlerResponse::Handled;
    });
    port_ = port == 0 ? server_.bind_to_any_port("127.0.0.1") : server_.bind_to_port("127.0.0.1", port) ? port : -1;
    if (port_ <= 0) {
      throw Failure(ExitCode::kUsage, "--port " + std::to_string(port) +
                                          ": the port is in use or may not be used; leave --port out for any free one");
    }
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      stopping_ = true;
      through_ = true;
    });
    while (!server_.is_running() && !stopping_)
      std::this_thread::sleep_for(milliseconds(1));  // before that it cannot be stopped
  }

  ~Implementation() {
    stopping_ = true;
    server_.stop();
    while (!through_) {
      EndConnections(port_);
      std::this_thread::sleep_for(milliseconds(20));
    }
    thread_.join();
  }

  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + path_; }

  std::string MakeUrlForOneUse() {
    const std::lock_guard<std::mutex> lock(mutex_);
    path_for_one_use_ = "/" + RandomToken() + "/";
    return "http://127.0.0.1:" + std::to_string(port_) + path_for_one_use_;
  }

 private:
  void Answer(const httplib::Request& request, httplib::Response& response) {
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Referrer-Policy", "no-referrer");
    response.set_header("Cache-Control", "no-store");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    if (!NamesServer(request.get_header_value("Host"), port_)) {
      return Refuse(response, 403, "This server answers requests to 127.0.0.1:" + std::to_string(port_) + " only.");
    }
    if (request.method == "GET" && IsForOneUse(request.path)) return response.set_redirect(path_, 303);
    if (request.path != path_ && request.path != path_ + "events") {
      return Refuse(response, 404, "There is no such page; use the address that rollgait view has printed.");
    }
    if (request.method != "GET") return Refuse(response, 405, "Only GET is answered.");
    if (request.path == path_) return SendPage(response);
    SendEvents(response);
  }

  // True once.
  bool IsForOneUse(const std::string& path) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (path_for_one_use_.empty() || path != path_for_one_use_) return false;
    path_for_one_use_.clear();
    return true;
  }

  // Piece by piece, since the library would compress a whole text, for a second.
  void SendPage(httplib::Response& response) {
    const std::string nonce = RandomToken();
    std::shared_ptr<const std::string> text;
    try {
      text = std::make_shared<const std::string>(make_page_(nonce));
    } catch (const std::exception& failure) {
      return Refuse(response, 500, failure.what());
    }
    response.set_header("Content-Security-Policy", PagePolicy(nonce) + "; frame-ancestors 'none'");
    response.set_content_provider(text->size(), "text/html; charset=utf-8",
                                  [text](size_t offset, size_t length, httplib::DataSink& sink) {
                                    return sink.write(text->data() + offset, std::min(length, kPiece));
                                  });
  }

  void SendEvents(httplib::Response& response) {
    if (++streams_ > kStreams) {
      --streams_;
      response.set_header("Retry-After", "5");
      return Refuse(response, 503, std::to_string(kStreams) + " pages follow the solve already; close one.");
    }
    const auto position = std::make_shared<LiveFeed::Position>();
    response.set_chunked_content_provider(
        "text/event-stream",
        [this, position](size_t, httplib::DataSink& sink) {
          std::string events;
          for (milliseconds waited{0}; events.empty() && waited < kPatience && !stopping_; waited += kBreath) {
            events = feed_.Wait(position.get(), kBreath);
          }
          if (stopping_) return false;
          if (events.empty()) events = ": still here\n\n";
          if (!sink.write(events.data(), events.size())) return false;
          if (position->ended) {
            sink.done();
          } else {
            std::this_thread::sleep_for(kBreath);
          }
          return true;
        },
        [this](bool) { --streams_; });
  }

  const MakePage make_page_;
  LiveFeed& feed_;
  const std::string path_;
  int port_ = -1;
  std::atomic<int> streams_{0};
  std::atomic<bool> stopping_{false}, through_{false};
  std::mutex mutex_;
  std::string path_for_one_use_;  // empty: none
  httplib::Server server_;
  std::thread thread_;
};

bool NamesServer(const std::string& host, int port) {
  for (const std::string name : {"127.0.0.1", "localhost"}) {
    if (host == name + ":" + std::to_string(port) || (port == 80 && host == name)) return true;
  }
  return false;
}

PageServer::PageServer(int port, MakePage make_page, LiveFeed& feed)
    : implementation_(std::make_unique<Implementation>(port, std::move(make_page), feed)) {}

PageServer::~PageServer() = default;

std::string PageServer::url() const { return implementation_->url(); }
std::string PageServer::MakeUrlForOneUse() { return implementation_->MakeUrlForOneUse(); }

}  // namespace rollgait::client
