#include "server/base/iterate_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace rollgait::server {
namespace {

// Of a file that is being written; ids of solves have no dot.
constexpr const char* kUnfinished = ".new";

Error CannotKeep(const std::string& what) { return {ErrorCode::kUnavailable, what + ": " + std::strerror(errno)}; }

bool WroteWhole(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = write(fd, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

}  // namespace

Outcome<Done> IterateFiles::MakeDirectory() const {
  if (mkdir(directory_.c_str(), 0700) != 0 && errno != EEXIST) return CannotKeep("cannot make " + directory_);
  return Done{};
}

Outcome<Done> IterateFiles::Put(const std::string& solve_id, std::string_view iterate) const {
  if (iterate.size() > kMaxIterateBytes) {
    return Error{ErrorCode::kInvalidArgument, "an iterate has " + std::to_string(iterate.size()) + " bytes; at most " +
                                                  std::to_string(kMaxIterateBytes) + " are shown"};
  }
  const std::string path = Path(solve_id), temporary = path + kUnfinished;
  const int fd = open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (fd < 0) return CannotKeep("cannot make " + temporary);
  const bool written = WroteWhole(fd, iterate);
  const int reason = errno;
  close(fd);
  errno = reason;
  if (written && rename(temporary.c_str(), path.c_str()) == 0) return Done{};
  const Error error = CannotKeep("cannot write " + path);
  unlink(temporary.c_str());
  return error;
}

void IterateFiles::Remove(const std::string& solve_id) const {
  unlink(Path(solve_id).c_str());
  unlink((Path(solve_id) + kUnfinished).c_str());
}

std::vector<std::string> IterateFiles::Owners() const {
  std::vector<std::string> ids;
  std::error_code failure;  // no directory: no owners
  for (std::filesystem::directory_iterator entry(directory_, failure), end; !failure && entry != end;
       entry.increment(failure)) {
    const std::string id = entry->path().stem().string();
    if (ids.empty() || ids.back() != id) ids.push_back(id);
  }
  return ids;
}

std::optional<std::string> IterateFiles::ReadNewer(const std::string& solve_id, Version* version) const {
  const int fd = open(Path(solve_id).c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return std::nullopt;
  std::optional<std::string> content;
  struct stat status;
  if (fstat(fd, &status) == 0 && status.st_size <= static_cast<off_t>(kMaxIterateBytes)) {
    const Version found{status.st_ino, status.st_mtim.tv_sec * int64_t{1'000'000'000} + status.st_mtim.tv_nsec};
    if (found != *version) {
      content.emplace(static_cast<size_t>(status.st_size), '\0');
      if (read(fd, content->data(), content->size()) != static_cast<ssize_t>(content->size())) {
        content.reset();
      } else {
        *version = found;
      }
    }
  }
  close(fd);
  return content;
}

}  // namespace rollgait::server
