#include "bench/delayed_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <deque>
#include <list>
#include <utility>
#include <vector>

#include "core/base/check.h"

namespace rollgait {
namespace {

using Clock = std::chrono::steady_clock;

sockaddr_un AddressOf(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  ROLLGAIT_CHECK(path.size() < sizeof address.sun_path);
  std::copy(path.begin(), path.end(), address.sun_path);
  return address;
}

int NewSocket() {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ROLLGAIT_CHECK(fd >= 0);
  return fd;
}

// One way of a connection.
struct Way {
  int from = -1, to = -1;
  std::deque<std::pair<Clock::time_point, std::string>> held = {};  // and when it is due
  bool open = true;

  void Read(std::chrono::microseconds delay) {
    std::array<char, 1 << 16> bytes;
    const ssize_t size = recv(from, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size > 0) held.emplace_back(Clock::now() + delay, std::string(bytes.data(), static_cast<size_t>(size)));
    if (size == 0 || (size < 0 && errno != EAGAIN && errno != EINTR)) open = false;
  }
  // What is due and the receiver takes.
  void Write() {
    while (!held.empty() && held.front().first <= Clock::now()) {
      std::string& bytes = held.front().second;
      const ssize_t size = send(to, bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
      if (size < 0) {
        if (errno != EAGAIN && errno != EINTR) open = false;
        return;
      }
      bytes.erase(0, static_cast<size_t>(size));
      if (bytes.empty()) held.pop_front();
    }
  }
};

}  // namespace

DelayedSocket::DelayedSocket(const std::string& path, const std::string& target, std::chrono::microseconds each_way)
    : target_(target), each_way_(each_way), listener_(NewSocket()) {
  const sockaddr_un address = AddressOf(path);
  ROLLGAIT_CHECK(bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  ROLLGAIT_CHECK(listen(listener_, 100) == 0);
  thread_ = std::thread([this] { Loop(); });
}

DelayedSocket::~DelayedSocket() {
  stopping_ = true;
  thread_.join();
  close(listener_);
}

void DelayedSocket::Loop() {
  std::list<std::array<Way, 2>> connections;
  while (!stopping_) {
    std::vector<pollfd> entries = {{listener_, POLLIN, 0}};
    Clock::time_point wake = Clock::now() + std::chrono::milliseconds(50);
    for (const auto& ways : connections) {
      for (const Way& way : ways) {
        entries.push_back({way.from, POLLIN, 0});
        if (!way.held.empty()) wake = std::min(wake, way.held.front().first);
      }
    }
    const auto left = std::max<int64_t>(0, std::chrono::nanoseconds(wake - Clock::now()).count());
    const timespec limit = {0, static_cast<long>(left)};
    ROLLGAIT_CHECK(ppoll(entries.data(), entries.size(), &limit, nullptr) >= 0 || errno == EINTR);
    size_t i = 0;
    const bool called = (entries[i++].revents & POLLIN) != 0;
    for (auto& ways : connections) {
      for (Way& way : ways) {
        if (entries[i++].revents != 0) way.Read(each_way_);
        way.Write();
      }
    }
    connections.remove_if([](const std::array<Way, 2>& ways) {
      if (ways[0].open && ways[1].open) return false;
      close(ways[0].from);
      close(ways[0].to);
      return true;
    });
    if (!called) continue;
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC), server = NewSocket();
    const sockaddr_un address = AddressOf(target_);
    ROLLGAIT_CHECK(client >= 0 && connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    connections.push_back({Way{client, server}, Way{server, client}});
  }
  for (const auto& ways : connections) {
    close(ways[0].from);
    close(ways[0].to);
  }
}

}  // namespace rollgait
