#ifndef ROLLGAIT_SERVER_BASE_ITERATE_FILES_H_
#define ROLLGAIT_SERVER_BASE_ITERATE_FILES_H_

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/base/outcome.h"

namespace rollgait::server {

// Bytes of one rollgait.v1.Iterate: what is longer is not shown.
inline constexpr size_t kMaxIterateBytes = size_t{64} << 10;
// Between two iterates of a solve: the solver sends none sooner, and the agent keeps none sooner.
inline constexpr std::chrono::milliseconds kIteratePause{250};

// The newest iterate of each running solve, one file each, which an agent writes and rollgaitd reads. For those who
// watch: nothing depends on it, and a machine that loses its power may lose it. Immutable; any thread and process.
class IterateFiles {
 public:
  // The directory need not be there: then there are none.
  explicit IterateFiles(std::string directory) : directory_(std::move(directory)) {}

  // Makes the directory if need be. kUnavailable with the reason.
  Outcome<Done> MakeDirectory() const;
  // Takes the place of the one before; readers see one of them, whole. kInvalidArgument: more than kMaxIterateBytes;
  // kUnavailable with the reason.
  Outcome<Done> Put(const std::string& solve_id, std::string_view iterate) const;
  void Remove(const std::string& solve_id) const;
  // Solves that have one, ended ones included whose agent died before it could remove it.
  std::vector<std::string> Owners() const;

  // Which file was read.
  struct Version {
    uint64_t inode = 0;
    int64_t time_ns = 0;
    bool operator==(const Version&) const = default;
  };
  // The newest one if it is not the one of `version`, which is set to it. nullopt: it is, or there is none.
  std::optional<std::string> ReadNewer(const std::string& solve_id, Version* version) const;

 private:
  std::string Path(const std::string& solve_id) const { return directory_ + "/" + solve_id; }

  const std::string directory_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_ITERATE_FILES_H_
