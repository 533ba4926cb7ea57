#include "server/base/notify.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

namespace rollgait::server {
namespace {

Error Unavailable(const std::string& what) { return {ErrorCode::kUnavailable, what + ": " + std::strerror(errno)}; }

// The address of `name` in an open directory. Going through /proc keeps it shorter than the 108 bytes of sun_path.
sockaddr_un AddressIn(int directory_fd, const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = "/proc/self/fd/" + std::to_string(directory_fd) + "/" + name;
  ROLLGAIT_CHECK(path.size() < sizeof(address.sun_path));
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

const sockaddr* Generic(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

}  // namespace

Outcome<NotifyReceiver> NotifyReceiver::Create(const std::string& directory, const std::string& name) {
  const int directory_fd = open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (directory_fd < 0) return Unavailable("cannot open the directory " + directory);
  const std::string path = directory + "/" + name;
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  unlink(path.c_str());
  const sockaddr_un address = AddressIn(directory_fd, name);
  const bool bound = fd >= 0 && bind(fd, Generic(address), sizeof(address)) == 0;
  std::optional<SocketFile> file = bound ? SocketFile::At(path) : std::nullopt;
  if (!file.has_value()) {
    const Error error = Unavailable("cannot listen on the socket " + path);
    if (fd >= 0) close(fd);
    close(directory_fd);
    return error;
  }
  close(directory_fd);
  return NotifyReceiver(fd, *std::move(file));
}

NotifyReceiver::NotifyReceiver(NotifyReceiver&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), file_(std::move(other.file_)) {}

NotifyReceiver& NotifyReceiver::operator=(NotifyReceiver&& other) noexcept {
  if (this != &other) {
    Close();
    fd_ = std::exchange(other.fd_, -1);
    file_ = std::move(other.file_);
  }
  return *this;
}

NotifyReceiver::~NotifyReceiver() { Close(); }

void NotifyReceiver::Close() {
  if (fd_ < 0) return;
  file_.Remove();
  close(fd_);
  fd_ = -1;
}

std::vector<std::string> NotifyReceiver::Drain() {
  std::vector<std::string> texts;
  std::array<char, kNotifyMaxBytes> buffer;
  while (true) {
    const ssize_t size = recv(fd_, buffer.data(), buffer.size(), MSG_DONTWAIT);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0) return texts;
    std::string text(buffer.data(), static_cast<size_t>(size));
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(std::move(text));
  }
}

Outcome<NotifySender> NotifySender::Create(const std::string& directory, const std::string& name) {
  const int directory_fd = open(directory.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC);
  if (directory_fd < 0) return Unavailable("cannot open the directory " + directory);
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) {
    const Error error = Unavailable("cannot make a socket");
    close(directory_fd);
    return error;
  }
  return NotifySender(fd, directory_fd, name);
}

NotifySender::NotifySender(NotifySender&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)),
      directory_fd_(std::exchange(other.directory_fd_, -1)),
      name_(std::move(other.name_)) {}

NotifySender& NotifySender::operator=(NotifySender&& other) noexcept {
  if (this != &other) {
    Close();
    fd_ = std::exchange(other.fd_, -1);
    directory_fd_ = std::exchange(other.directory_fd_, -1);
    name_ = std::move(other.name_);
  }
  return *this;
}

NotifySender::~NotifySender() { Close(); }

void NotifySender::Close() {
  if (fd_ >= 0) close(std::exchange(fd_, -1));
  if (directory_fd_ >= 0) close(std::exchange(directory_fd_, -1));
}

bool NotifySender::Send(std::string_view text) const {
  const sockaddr_un address = AddressIn(directory_fd_, name_);
  const size_t size = std::min(text.size(), kNotifyMaxBytes);
  return sendto(fd_, text.data(), size, MSG_DONTWAIT | MSG_NOSIGNAL, Generic(address), sizeof(address)) ==
         static_cast<ssize_t>(size);
}

Outcome<std::unique_ptr<HintChannel>> SocketHints::Create(const std::string& directory, const std::string& own_name,
                                                          const std::string& other_name) {
  Outcome<NotifyReceiver> receiver = NotifyReceiver::Create(directory, own_name);
  if (!receiver.ok()) return receiver.error();
  Outcome<NotifySender> sender = NotifySender::Create(directory, other_name);
  if (!sender.ok()) return sender.error();
  return std::unique_ptr<HintChannel>(new SocketHints(std::move(receiver).value(), std::move(sender).value()));
}

}  // namespace rollgait::server
