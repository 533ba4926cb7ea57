#include "tests/faults/load.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

namespace rollgait::faults {
namespace {

using std::chrono::milliseconds;

std::chrono::system_clock::time_point Within(std::chrono::milliseconds time) {
  return std::chrono::system_clock::now() + time;
}

// The same call may succeed later. CANCELLED, which no call of this load asks for, is how gRPC ends those that a
// stopping server has not taken up.
bool TryAgain(grpc::StatusCode code) {
  return code == grpc::StatusCode::UNAVAILABLE || code == grpc::StatusCode::DEADLINE_EXCEEDED ||
         code == grpc::StatusCode::RESOURCE_EXHAUSTED || code == grpc::StatusCode::CANCELLED;
}

double TimeOf(const v1::SolveEvent& event) {
  return static_cast<double>(event.time().seconds()) + 1e-9 * event.time().nanos();
}

bool IsTerminal(v1::SolveState state) {
  return state == v1::SOLVE_STATE_SUCCEEDED || state == v1::SOLVE_STATE_FAILED || state == v1::SOLVE_STATE_CANCELLED;
}

std::string Canonical(v1::SolveEvent event) {
  event.clear_skipped_count();
  return event.SerializeAsString();
}

// Calls until the answer is not "try again".
template <typename Call>
grpc::Status Persist(const Call& call, const std::function<bool()>& given_up) {
  while (true) {
    grpc::ClientContext context;
    context.set_deadline(Within(milliseconds(10'000)));
    const grpc::Status status = call(context);
    if (!TryAgain(status.error_code()) || given_up()) return status;
    std::this_thread::sleep_for(milliseconds(20));
  }
}

}  // namespace

std::unique_ptr<Stub> Connect(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetInt(GRPC_ARG_INITIAL_RECONNECT_BACKOFF_MS, 50);
  arguments.SetInt(GRPC_ARG_MIN_RECONNECT_BACKOFF_MS, 5'000);  // how long one attempt may take
  arguments.SetInt(GRPC_ARG_MAX_RECONNECT_BACKOFF_MS, 200);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIME_MS, 6'000);
  arguments.SetInt(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, 4'000);
  return v1::GaitService::NewStub(grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments));
}

std::unique_ptr<grpc::ClientContext> CallAs(const std::string& token, std::chrono::milliseconds at_most) {
  auto context = std::make_unique<grpc::ClientContext>();
  context->AddMetadata("authorization", "Bearer " + token);
  context->set_deadline(std::chrono::system_clock::now() + at_most);
  return context;
}

void Verdict::Add(const Verdict& other) {
  for (int64_t Verdict::*count :
       {&Verdict::acknowledged, &Verdict::succeeded, &Verdict::dead_letters, &Verdict::lost, &Verdict::duplicated,
        &Verdict::gaps, &Verdict::changed, &Verdict::retried, &Verdict::reattached, &Verdict::unexpected}) {
    this->*count += other.*count;
  }
  longest_retry_s = std::max(longest_retry_s, other.longest_retry_s);
  if (first_problem.empty()) first_problem = other.first_problem;
}

std::string Verdict::Text() const {
  std::ostringstream text;
  text << acknowledged << " acknowledged: " << lost << " lost, " << duplicated << " duplicated, " << gaps << " gaps, "
       << changed << " changed; " << reattached << " re-attached, " << retried << " retried (longest pause "
       << longest_retry_s << " s), " << dead_letters << " dead letters";
  if (unexpected > 0) text << ", " << unexpected << " unexpected answers";
  if (!first_problem.empty()) text << "; first problem: " << first_problem;
  return text.str();
}

Load::Load(Options options) : options_(std::move(options)), rounds_(static_cast<size_t>(options_.clients), 0) {
  for (int i = 0; i < options_.clients; ++i) threads_.emplace_back([this, i] { Client(i); });
}

Load::~Load() {
  stopping_ = true;
  give_up_at_ = 0;
  for (std::thread& thread : threads_) thread.join();
}

void Load::AwaitRound() {
  const auto rounds = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    return rounds_;
  };
  const std::vector<int64_t> before = rounds();
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
  const auto all_went_on = [&] {
    const std::vector<int64_t> now = rounds();
    for (size_t i = 0; i < now.size(); ++i) {
      if (now[i] == before[i]) return false;
    }
    return true;
  };
  while (!all_went_on()) {
    if (std::chrono::steady_clock::now() > deadline)
      throw std::runtime_error("a client waited two minutes for its solve");
    std::this_thread::sleep_for(milliseconds(10));
  }
}

void Load::Problem(int64_t Verdict::*count, const std::string& what) {
  const std::lock_guard<std::mutex> lock(mutex_);
  verdict_.*count += 1;
  if (verdict_.first_problem.empty()) verdict_.first_problem = what;
}

void Load::Client(int number) {
  const std::unique_ptr<Stub> stub = Connect(options_.address);
  for (int i = 0; !stopping_; ++i) {
    Watched watched;
    watched.request_id = "client-" + std::to_string(number) + "-" + std::to_string(i);
    watched.spec.mutable_model()->set_name("planar");
    watched.spec.set_slope_rad(1e-8 * (1 + number + options_.clients * i));
    watched.spec.mutable_solver_limits()->set_max_iterations(options_.iterations);
    if (!Create(*stub, &watched)) continue;
    if (WatchToEnd(*stub, &watched)) ++finished_;
    const std::lock_guard<std::mutex> lock(mutex_);
    ++rounds_[static_cast<size_t>(number)];
    watched_.push_back(std::move(watched));
  }
}

bool Load::Create(Stub& stub, Watched* watched) {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = watched->spec;
  request.set_request_id(watched->request_id);
  v1::Solve solve;
  const grpc::Status status =
      Persist([&](grpc::ClientContext& context) { return stub.CreateSolve(&context, request, &solve); },
              [this] { return GivenUp(); });
  if (!status.ok()) {
    Problem(&Verdict::unexpected, "CreateSolve " + watched->request_id + ": " + status.error_message());
    return false;
  }
  watched->name = solve.name();
  const std::lock_guard<std::mutex> lock(mutex_);
  ++verdict_.acknowledged;
  return true;
}

void Load::Take(const v1::SolveEvent& event, Watched* watched) {
  const std::string where = watched->name + " event " + std::to_string(event.sequence());
  if (event.has_heartbeat()) {
    if (event.sequence() != watched->last) Problem(&Verdict::gaps, where + ": heartbeat with another number");
    return;
  }
  if (event.sequence() != watched->last + event.skipped_count() + 1) {
    Problem(&Verdict::gaps, where + " after " + std::to_string(watched->last));
  }
  watched->last = event.sequence();
  watched->events[event.sequence()] = Canonical(event);
  if (!event.has_finished()) return;
  if (++watched->terminals > 1) Problem(&Verdict::duplicated, where + ": a second end");
  watched->finished = event.finished();
}

bool Load::WatchToEnd(Stub& stub, Watched* watched) {
  while (watched->terminals == 0 && !GivenUp()) {
    grpc::ClientContext context;
    context.set_deadline(Within(milliseconds(20'000)));  // a client that waits for nobody
    v1::WatchSolveRequest request;
    request.set_name(watched->name);
    request.set_after_sequence(watched->last);
    const auto stream = stub.WatchSolve(&context, request);
    v1::SolveEvent event;
    while (stream->Read(&event)) Take(event, watched);
    const grpc::Status status = stream->Finish();
    if (watched->terminals > 0) break;
    if (!TryAgain(status.error_code())) {
      Problem(&Verdict::unexpected, "WatchSolve " + watched->name + " ended with code " +
                                        std::to_string(status.error_code()) + " " + status.error_message());
      return false;
    }
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ++verdict_.reattached;
    }
    std::this_thread::sleep_for(milliseconds(20));
  }
  return watched->terminals > 0;
}

void Load::Compare(Stub& stub, const Watched& watched, Verdict* verdict) {
  const auto problem = [&](int64_t Verdict::*count, const std::string& what) {
    verdict->*count += 1;
    if (verdict->first_problem.empty()) verdict->first_problem = watched.name + " " + what;
  };
  v1::GetSolveRequest get;
  get.set_name(watched.name);
  v1::Solve solve;
  const auto given_up = [this] { return GivenUp(); };
  const grpc::Status status =
      Persist([&](grpc::ClientContext& context) { return stub.GetSolve(&context, get, &solve); }, given_up);
  if (!status.ok()) return problem(&Verdict::lost, "cannot be read: " + status.error_message());
  if (!IsTerminal(solve.state())) return problem(&Verdict::lost, "has not ended");
  if (watched.terminals == 0) return problem(&Verdict::lost, "has ended without its watcher being told");
  if (solve.SerializeAsString() != watched.finished.SerializeAsString()) {
    problem(&Verdict::lost, "is another than its watcher was told");
  }
  (solve.state() == v1::SOLVE_STATE_SUCCEEDED ? verdict->succeeded : verdict->dead_letters) += 1;
  verdict->retried += solve.attempts() - 1;

  v1::WatchSolveRequest request;
  request.set_name(watched.name);
  int64_t last = 0;
  double alive = 0;
  Persist(
      [&](grpc::ClientContext& context) {
        last = 0;
        const auto stream = stub.WatchSolve(&context, request);
        v1::SolveEvent event;
        while (stream->Read(&event)) {
          if (event.has_heartbeat()) continue;
          if (event.sequence() != last + event.skipped_count() + 1) problem(&Verdict::gaps, "has a gap in its log");
          last = event.sequence();
          const auto seen = watched.events.find(last);
          if (seen != watched.events.end() && seen->second != Canonical(event)) {
            problem(&Verdict::changed, "event " + std::to_string(last) + " reads otherwise now");
          }
          const bool runs = event.has_state_change() && event.state_change().state() == v1::SOLVE_STATE_RUNNING;
          if (runs && event.state_change().attempt() > 1) {
            verdict->longest_retry_s = std::max(verdict->longest_retry_s, TimeOf(event) - alive);
          }
          if (runs || event.has_iteration()) alive = TimeOf(event);
        }
        return stream->Finish();
      },
      given_up);
  if (last != watched.last) problem(&Verdict::gaps, "has another number of events now");
}

Verdict Load::Finish(std::chrono::seconds at_most) {
  stopping_ = true;
  give_up_at_ = (std::chrono::steady_clock::now() + at_most).time_since_epoch().count();
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  Verdict verdict = verdict_;
  const std::unique_ptr<Stub> stub = Connect(options_.address);
  std::set<std::string> expected;
  for (const Watched& watched : watched_) {
    if (!expected.insert(watched.name).second) ++verdict.duplicated;
    Compare(*stub, watched, &verdict);
  }
  v1::ListSolvesRequest request;
  request.set_page_size(1000);
  do {
    v1::ListSolvesResponse page;
    const grpc::Status status =
        Persist([&](grpc::ClientContext& context) { return stub->ListSolves(&context, request, &page); },
                [this] { return GivenUp(); });
    if (!status.ok()) ++verdict.unexpected;
    for (const v1::Solve& solve : page.solves()) {
      if (expected.erase(solve.name()) > 0) continue;
      ++verdict.duplicated;
      if (verdict.first_problem.empty()) verdict.first_problem = solve.name() + " answers no request of ours";
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  verdict.lost += static_cast<int64_t>(expected.size());  // not listed
  return verdict;
}

}  // namespace rollgait::faults
