#ifndef ROLLGAIT_SERVER_STORE_WRITE_TURN_H_
#define ROLLGAIT_SERVER_STORE_WRITE_TURN_H_

#include <chrono>
#include <string>

namespace rollgait::server {

// The place of the process that writes next to an SQLite file. SQLite wakes nobody when its writer's lock becomes free:
// who waits looks again after up to 100 ms, and a process that writes one transaction after the other is always there
// before. Whoever holds the place alone asks for the lock, and leaves the place once it has it, so that the one who has
// just written stands behind. A flock, which ends with its process. One thread at a time.
class WriteTurn {
 public:
  static constexpr std::chrono::microseconds kLook{500};  // from one look to the next, at this place and at the lock

  // The file is made if need be when the place is first taken.
  explicit WriteTurn(std::string path) : path_(std::move(path)) {}
  WriteTurn(const WriteTurn&) = delete;
  WriteTurn& operator=(const WriteTurn&) = delete;
  ~WriteTurn();

  // False: another one held it until then. Throws SqlFailure if the file cannot be opened or locked.
  bool Take(std::chrono::steady_clock::time_point until);
  void Leave() noexcept;

 private:
  const std::string path_;
  int fd_ = -1;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_WRITE_TURN_H_
