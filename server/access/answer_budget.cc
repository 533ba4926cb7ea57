#include "server/access/answer_budget.h"

#include <chrono>
#include <utility>

namespace rollgait::server {
namespace {

std::string MiB(int64_t bytes) {
  const int64_t tenths = (10 * bytes + (1 << 19)) >> 20;
  return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) + " MiB";
}

Error Refusal(AnswerBudget::Limit limit, const std::string& tenant, int64_t held, int64_t more, int64_t most) {
  const std::string whose = limit == AnswerBudget::kConnection ? "of this connection"
                            : limit == AnswerBudget::kTenant   ? "of tenant \"" + tenant + "\""
                                                               : "of all clients";
  const std::string text = "answers " + whose + " that were not read yet take " + MiB(held) + ", this one needs " +
                           MiB(more) + " and the limit is " + MiB(most);
  Error error{ErrorCode::kResourceExhausted, text + "; read those first", {}, std::chrono::milliseconds(1000)};
  if (limit != AnswerBudget::kAll) error.quota = {"tenant:" + tenant, text};
  return error;
}

void Add(std::map<std::string, int64_t>& accounts, const std::string& name, int64_t bytes) {
  const auto account = accounts.try_emplace(name, 0).first;
  account->second += bytes;
  if (account->second == 0) accounts.erase(account);
}

int64_t Of(const std::map<std::string, int64_t>& accounts, const std::string& name) {
  const auto account = accounts.find(name);
  return account == accounts.end() ? 0 : account->second;
}

}  // namespace

AnswerHold::~AnswerHold() { static_cast<void>(budget_->Change(*this, 0, false)); }

Outcome<Done> AnswerHold::Hold(int64_t bytes) { return budget_->Change(*this, AnswerBudget::kEveryCall + bytes, true); }

void AnswerHold::Owe(int64_t bytes) {
  static_cast<void>(budget_->Change(*this, AnswerBudget::kEveryCall + bytes, false));
}

Outcome<std::unique_ptr<AnswerHold>> AnswerBudget::Open(const std::string& connection, const std::string& tenant) {
  std::unique_ptr<AnswerHold> hold(new AnswerHold(shared_from_this(), connection, tenant));
  Outcome<Done> held = hold->Hold(0);
  if (!held.ok()) return held.error();
  return hold;
}

Outcome<Done> AnswerBudget::Change(AnswerHold& hold, int64_t to, bool may_refuse) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const int64_t more = to - hold.held_;
  if (may_refuse && more > 0) {
    const std::array<std::pair<int64_t, int64_t>, 3> held_and_most = {
        std::pair{Of(connections_, hold.connection_), limits_.connection},
        std::pair{Of(tenants_, hold.tenant_), limits_.tenant}, std::pair{all_, limits_.all}};
    for (const Limit limit : {kConnection, kTenant, kAll}) {
      const auto [held, most] = held_and_most[limit];
      if (held + more <= most) continue;
      ++refused_[limit];
      return Refusal(limit, hold.tenant_, held, more, most);
    }
  }
  Add(connections_, hold.connection_, more);
  Add(tenants_, hold.tenant_, more);
  all_ += more;
  hold.held_ = to;
  return Done{};
}

int64_t AnswerBudget::held() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return all_;
}

std::array<int64_t, 3> AnswerBudget::refused() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return refused_;
}

}  // namespace rollgait::server
