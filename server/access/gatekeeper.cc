#include "server/access/gatekeeper.h"

#include <spdlog/spdlog.h>
#include <strings.h>

#include <set>
#include <utility>
#include <vector>

namespace rollgait::server {
namespace {

constexpr char kBearer[] = "Bearer ";
constexpr double kAuditedRefusalsPerSecond = 2;
constexpr size_t kMostKnownLimits = 10'000;
constexpr size_t kMostKnownTokens = 10'000;
constexpr char kLaneOfStrangers[] = "?";  // no tenant's name

Error Unauthenticated(const std::string& message) { return {ErrorCode::kUnauthenticated, message}; }

const Error& NoSuchToken() {
  // The same for every text that is no token, so that nothing is learned about those that are.
  static const Error error = Unauthenticated("the token is not valid; ask the server's administrator for one");
  return error;
}

Error Withdrawn(const TokenRecord& token) {
  return Unauthenticated(token.revoke_time_us != 0 ? "the token " + token.id + " was revoked; ask for a new one"
                                                   : "the token " + token.id + " has expired; ask for a new one");
}

// The scheme's name has no case (RFC 9110, 11.1).
bool StartsWithBearer(const std::string& authorization) {
  const size_t size = sizeof(kBearer) - 1;
  return authorization.size() >= size && strncasecmp(authorization.c_str(), kBearer, size) == 0;
}

}  // namespace

Admission::Admission(Gatekeeper& gatekeeper, Caller caller) : gatekeeper_(gatekeeper), caller_(std::move(caller)) {
  const std::lock_guard<std::mutex> lock(gatekeeper_.admissions_mutex_);
  ++gatekeeper_.admissions_;
}

Admission::~Admission() {
  if (registered_) {
    const std::lock_guard<std::mutex> lock(gatekeeper_.streams_mutex_);
    gatekeeper_.streams_.erase(this);
  }
  const std::lock_guard<std::mutex> lock(gatekeeper_.admissions_mutex_);
  if (--gatekeeper_.admissions_ == 0) gatekeeper_.left_.notify_all();
}

void Admission::OweCreates(int count) {
  gatekeeper_.quotas_.OweCreates(caller_.tenant, caller_.limits.creates_per_s, count);
}

void Admission::WhenWithdrawn(std::function<void(const Error&)> end) {
  if (caller_.authentication != Authentication::kToken) return;
  registered_ = true;
  const std::lock_guard<std::mutex> lock(gatekeeper_.streams_mutex_);
  gatekeeper_.streams_[this] = std::move(end);
}

Gatekeeper::Gatekeeper(const Options& options, AccessStore* store, const Clock* clock)
    : options_(options),
      store_(store),
      clock_(clock),
      backpressure_(options.most_creates_at_once),
      answers_(std::make_shared<AnswerBudget>(options.answers)) {
  if (options_.require_identity && store_ != nullptr) watcher_ = std::thread([this] { Watch(); });
}

Gatekeeper::~Gatekeeper() {
  {
    const std::lock_guard<std::mutex> lock(streams_mutex_);
    stopping_ = true;
  }
  stopped_.notify_all();
  if (watcher_.joinable()) watcher_.join();
}

Outcome<std::shared_ptr<void>> Gatekeeper::Check(const MethodRule& rule, const std::string& lane) {
  if (draining_) {
    return Error{ErrorCode::kUnavailable,
                 "the server is stopping; call again, another one or this one will answer",
                 {},
                 std::chrono::milliseconds(1000)};
  }
  if (!rule.creates) return std::shared_ptr<void>();
  return backpressure_.Enter(lane);
}

Outcome<std::shared_ptr<Admission>> Gatekeeper::Admit(const MethodRule& rule, const Presented& presented,
                                                      std::shared_ptr<void> place) {
  Outcome<Caller> caller = Identify(presented);
  if (!caller.ok()) {
    if (caller.error().code == ErrorCode::kUnauthenticated) AuditRefusal(rule, presented, "", caller.error());
    return caller.error();
  }
  const Caller& known = caller.value();
  if ((known.scopes & rule.scope) == 0) {
    const Error error{ErrorCode::kPermissionDenied, std::string(rule.name) + " needs the scope " +
                                                        ScopeNames(rule.scope) + "; " + known.identity + " has " +
                                                        ScopeNames(known.scopes)};
    AuditRefusal(rule, presented, known.identity, error);
    return error;
  }
  if (rule.creates) {
    if (std::optional<Error> fast = quotas_.TakeCreate(known.tenant, known.limits.creates_per_s))
      return *std::move(fast);
  }
  Outcome<std::unique_ptr<AnswerHold>> answer = answers_->Open(presented.peer, known.tenant);
  if (!answer.ok()) return answer.error();
  std::shared_ptr<Admission> admission(new Admission(*this, known));
  admission->answer_ = std::move(answer).value();
  admission->place_ = std::move(place);
  if (rule.watches) {
    Outcome<std::shared_ptr<void>> watch = quotas_.TakeWatch(known.tenant, known.limits.max_watches);
    if (!watch.ok()) return watch.error();
    admission->watch_ = std::move(watch).value();
  }
  if (rule.simulates) {
    Outcome<std::shared_ptr<void>> simulation = quotas_.TakeSimulation(known.tenant, known.limits.max_simulations);
    if (!simulation.ok()) return simulation.error();
    admission->simulation_ = std::move(simulation).value();
  }
  return admission;
}

Outcome<Caller> Gatekeeper::Identify(const Presented& presented) {
  Caller caller;
  caller.peer = presented.peer;
  caller.traceparent = presented.traceparent;
  if (!options_.require_identity) {
    caller.limits = options_.limits;
    return caller;
  }
  if (!presented.authorization.empty()) {
    Outcome<Caller> by_token = ByToken(presented);
    if (!by_token.ok()) return by_token.error();
    caller = std::move(by_token).value();
  } else if (!presented.certificate_name.empty()) {
    caller.authentication = Authentication::kCertificate;
    caller.tenant = caller.identity = presented.certificate_name;
    caller.scopes = kScopeRead | kScopeSolve;
  } else {
    return Unauthenticated("this server asks for a token: send the header \"authorization: Bearer TOKEN\"");
  }
  if (!IsTenantName(caller.tenant)) return Unauthenticated("the name in the certificate is not that of a tenant");
  Outcome<TenantLimits> limits = LimitsOf(caller.tenant);
  if (!limits.ok()) return limits.error();
  caller.limits = limits.value();
  return caller;
}

std::string Gatekeeper::LaneOf(const Presented& presented) {
  if (!options_.require_identity) return "";
  if (presented.authorization.empty()) {
    return presented.certificate_name.empty() ? kLaneOfStrangers : presented.certificate_name;
  }
  if (!StartsWithBearer(presented.authorization)) return kLaneOfStrangers;
  const std::optional<Token> token =
      Token::Parse(std::string_view(presented.authorization).substr(sizeof(kBearer) - 1));
  if (!token) return kLaneOfStrangers;
  const std::lock_guard<std::mutex> lock(lanes_mutex_);
  const auto known = tenants_of_tokens_.find(token->Hash());
  return known == tenants_of_tokens_.end() ? kLaneOfStrangers : known->second;
}

Outcome<Caller> Gatekeeper::ByToken(const Presented& presented) {
  if (!StartsWithBearer(presented.authorization)) return NoSuchToken();
  const std::optional<Token> token =
      Token::Parse(std::string_view(presented.authorization).substr(sizeof(kBearer) - 1));
  if (!token) return NoSuchToken();
  const Outcome<std::optional<TokenRecord>> record = store_->FindToken(token->id);
  if (!record.ok()) return record.error();
  if (!record.value() || !SameHash(record.value()->hash, token->Hash())) return NoSuchToken();
  const TokenRecord& known = *record.value();
  if (!known.valid_at(clock_->WallMicros())) return Withdrawn(known);
  Caller caller;
  caller.authentication = Authentication::kToken;
  caller.tenant = known.tenant;
  caller.identity = known.id;
  caller.peer = presented.peer;
  caller.traceparent = presented.traceparent;
  {
    const std::lock_guard<std::mutex> lock(lanes_mutex_);
    if (tenants_of_tokens_.size() >= kMostKnownTokens) tenants_of_tokens_.clear();
    tenants_of_tokens_[token->Hash()] = known.tenant;
  }
  caller.scopes = (known.scopes & kScopeAdmin) != 0 ? static_cast<unsigned>(kAllScopes) : known.scopes;
  return caller;
}

Outcome<TenantLimits> Gatekeeper::LimitsOf(const std::string& tenant) {
  const auto now = std::chrono::steady_clock::now();
  {
    const std::lock_guard<std::mutex> lock(limits_mutex_);
    const auto known = known_limits_.find(tenant);
    if (known != known_limits_.end() && now - known->second.read < options_.recheck) return known->second.limits;
    if (known_limits_.size() >= kMostKnownLimits) known_limits_.clear();
  }
  const Outcome<TenantOverrides> own = store_->FindTenant(tenant);
  if (!own.ok()) return own.error();
  TenantLimits limits = options_.limits;
  limits.max_queued = own.value().max_queued.value_or(limits.max_queued);
  limits.max_running = own.value().max_running.value_or(0);
  limits.max_watches = own.value().max_watches.value_or(limits.max_watches);
  limits.max_simulations = own.value().max_simulations.value_or(limits.max_simulations);
  limits.max_storage_bytes = own.value().max_storage_bytes.value_or(limits.max_storage_bytes);
  limits.creates_per_s = own.value().creates_per_s.value_or(limits.creates_per_s);
  const std::lock_guard<std::mutex> lock(limits_mutex_);
  known_limits_[tenant] = {limits, now};
  return limits;
}

bool Gatekeeper::WaitUntilLeft(std::chrono::milliseconds at_most) {
  std::unique_lock<std::mutex> lock(admissions_mutex_);
  return left_.wait_for(lock, at_most, [this] { return admissions_ == 0; });
}

void Gatekeeper::AuditRefusal(const MethodRule& rule, const Presented& presented, const std::string& token_id,
                              const Error& error) {
  if (store_ == nullptr) return;
  std::string detail = error.message;
  {
    const std::lock_guard<std::mutex> lock(audit_mutex_);
    if (refusals_.TakeCreate("", kAuditedRefusalsPerSecond)) {
      ++refusals_left_out_;
      return;
    }
    if (refusals_left_out_ > 0)
      detail += " (" + std::to_string(std::exchange(refusals_left_out_, 0)) + " more before, not listed)";
  }
  const bool known = error.code == ErrorCode::kPermissionDenied;
  AuditRow row;
  row.actor = {"", token_id, presented.peer};
  row.action = std::string("call ") + rule.name;
  row.outcome = known ? "permission denied" : "unauthenticated";
  row.detail = std::move(detail);
  const Outcome<Done> written = store_->AddAudit(row);
  if (!written.ok()) spdlog::warn("an audit row was not written: {}", written.error().message);
}

void Gatekeeper::Watch() {
  std::unique_lock<std::mutex> lock(streams_mutex_);
  while (!stopped_.wait_for(lock, options_.recheck, [this] { return stopping_; })) {
    lock.unlock();
    Recheck();
    lock.lock();
  }
}

void Gatekeeper::Recheck() {
  std::set<std::string> ids;
  {
    const std::lock_guard<std::mutex> lock(streams_mutex_);
    for (const auto& [admission, end] : streams_) ids.insert(admission->caller().identity);
  }
  std::map<std::string, Error> withdrawn;
  for (const std::string& id : ids) {
    const Outcome<std::optional<TokenRecord>> token = store_->FindToken(id);
    if (!token.ok()) continue;  // the store does not answer now: nobody is thrown out for that
    if (!token.value()) {
      withdrawn.emplace(id, NoSuchToken());
    } else if (!token.value()->valid_at(clock_->WallMicros())) {
      withdrawn.emplace(id, Withdrawn(*token.value()));
    }
  }
  if (withdrawn.empty()) return;
  std::vector<std::pair<std::function<void(const Error&)>, Error>> ends;
  {
    const std::lock_guard<std::mutex> lock(streams_mutex_);
    for (const auto& [admission, end] : streams_) {
      const auto error = withdrawn.find(admission->caller().identity);
      if (error != withdrawn.end()) ends.emplace_back(end, error->second);
    }
  }
  // Outside the lock: the end of a stream destroys its admission.
  for (const auto& [end, error] : ends) end(error);
}

}  // namespace rollgait::server
