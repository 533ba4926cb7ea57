#ifndef ROLLGAIT_SERVER_ACCESS_ANSWER_BUDGET_H_
#define ROLLGAIT_SERVER_ACCESS_ANSWER_BUDGET_H_

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// Bytes that answers which clients have not read yet may occupy in this server. HTTP/2 lets a client ask for answers
// and read none, on thousands of streams.
struct AnswerLimits {
  // 40 results of 1.5 MB under way, more than a network keeps busy; above the longest answer, 51 MB.
  int64_t connection = int64_t{64} << 20;
  int64_t tenant = int64_t{128} << 20;  // two connections' worth, and a third of `all` is left to others
  int64_t all = int64_t{192} << 20;     // with gRPC's 256 MiB of requests below the 512 MiB of a small container
};

class AnswerBudget;

// What one call holds of the budget until it is destroyed. One thread at a time.
class AnswerHold {
 public:
  ~AnswerHold();
  AnswerHold(const AnswerHold&) = delete;
  AnswerHold& operator=(const AnswerHold&) = delete;

  // The call holds so many bytes from now on, besides what every call holds. kResourceExhausted beyond a limit: it
  // holds what it held. Fewer bytes than before are never refused.
  Outcome<Done> Hold(int64_t bytes);
  // The same, and never refused: for the answer of a call that has changed something. The next calls are refused then.
  void Owe(int64_t bytes);

 private:
  friend class AnswerBudget;
  AnswerHold(std::shared_ptr<AnswerBudget> budget, std::string connection, std::string tenant)
      : budget_(std::move(budget)), connection_(std::move(connection)), tenant_(std::move(tenant)) {}

  const std::shared_ptr<AnswerBudget> budget_;
  const std::string connection_, tenant_;
  int64_t held_ = 0;
};

// Counts what all calls hold against the limits of their connection, of their tenant and of the server. Any thread may
// call; nothing blocks.
class AnswerBudget : public std::enable_shared_from_this<AnswerBudget> {
 public:
  // What a call holds for as long as it is open: gRPC's own memory for a stream, rounded up.
  static constexpr int64_t kEveryCall = 16 << 10;
  enum Limit { kConnection, kTenant, kAll };
  static constexpr std::array<const char*, 3> kLimitNames = {"connection", "tenant", "server"};

  explicit AnswerBudget(const AnswerLimits& limits) : limits_(limits) {}

  // Begins a call, which holds kEveryCall. kResourceExhausted.
  Outcome<std::unique_ptr<AnswerHold>> Open(const std::string& connection, const std::string& tenant);
  int64_t held() const;
  // Calls that a limit has refused so far.
  std::array<int64_t, 3> refused() const;

 private:
  friend class AnswerHold;
  Outcome<Done> Change(AnswerHold& hold, int64_t to, bool may_refuse);

  const AnswerLimits limits_;
  mutable std::mutex mutex_;  // protects what follows
  std::map<std::string, int64_t> connections_, tenants_;
  int64_t all_ = 0;
  std::array<int64_t, 3> refused_{};
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_ACCESS_ANSWER_BUDGET_H_
