#include <iterator>
#include <optional>

#include "tests/schedules/event_words.h"
#include "tests/schedules/world.h"
#include "tests/server/service/service_fixture.h"

namespace rollgait::server {
namespace {

// A client that asks for solves, watches, cancels and deletes them, and makes a call again that was not answered.
class Client {
 public:
  Client(World& world, int number) : world_(world), name_("c" + std::to_string(number)) {
    // Equal requests of one tenant wait for one another, those of two take turns.
    caller_.authentication = Authentication::kToken;
    caller_.tenant = kTenants[number % std::size(kTenants)].name;
  }

  void Run() {
    const int requests = 1 + random().Below(2);
    for (int i = 0; i < requests && !world_.over; ++i) {
      const std::string tag = name_ + "r" + std::to_string(i);
      const bool batch = random().Chance(0.25);
      std::vector<std::string> tags = batch ? std::vector{tag + "a", tag + "b"} : std::vector{tag};
      for (int more = world_.plan.crowd ? 6 : 0; more > 0; --more) tags.push_back(tag + "m" + std::to_string(more));
      for (const std::string& id : Create(tags)) Follow(id);
    }
  }

 private:
  SeededNumbers& random() { return world_.scheduler.random(); }
  void Pause() { world_.scheduler.Sleep(random().Between(0, kSecond)); }

  // The answer of the server; kUnavailable if there is none or it was lost on its way.
  template <typename Call>
  auto Ask(const char* what, Call call) -> decltype(call(std::declval<ServerLife&>())) {
    const Error unavailable{ErrorCode::kUnavailable, "no answer"};
    const std::shared_ptr<ServerLife> life = world_.server;
    if (life == nullptr || life->process->dead) return unavailable;
    world_.scheduler.Note(std::string("asks: ") + what);
    std::optional<decltype(call(*life))> answer;
    try {
      answer.emplace(call(*life));
    } catch (const Crashed&) {
    }
    world_.scheduler.Yield();
    const bool lost = !world_.is_calm() && random().Chance(world_.plan.answer_loss);
    if (!answer || life->process->dead || lost) return unavailable;
    world_.scheduler.Note(std::string("is answered: ") + what + (answer->ok() ? "" : ", " + answer->error().message));
    return *std::move(answer);
  }

  // True: the call is to be made again. All other errors are none that a client should see.
  bool IsToRepeat(const char* what, const Error& error) {
    if (error.code == ErrorCode::kUnavailable) return true;
    if (error.code != ErrorCode::kNotFound) world_.Complain(std::string(what) + " is refused: " + error.message);
    return false;
  }

  v1::CreateSolveRequest Request(const std::string& tag, double slope) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = PlanarSpec(slope);
    request.set_request_id(tag);
    (*request.mutable_labels())["tag"] = tag;
    request.set_priority(random().Chance(0.5) ? 0 : random().Below(3) - 1);
    return request;
  }

  // Few, so that requests are equal; in a crowd many, so that they are not and wait for solvers.
  double Slope() { return world_.plan.crowd ? 0.01 * random().Below(20) : random().Chance(0.5) ? 0.1 : 0.2; }

  // The ids of the solves; empty: the client gives up.
  std::vector<std::string> Create(const std::vector<std::string>& tags) {
    v1::BatchCreateSolvesRequest batch;
    for (const std::string& tag : tags) *batch.add_requests() = Request(tag, Slope());
    while (!world_.over && !random().Chance(0.03)) {
      const Outcome<v1::BatchCreateSolvesResponse> made =
          Ask("create", [&](ServerLife& life) { return CreateAt(life, batch); });
      if (made.ok()) {
        std::vector<std::string> ids;
        for (int i = 0; i < made.value().solves_size(); ++i) {
          ids.push_back(SolveId(made.value().solves(i).name()).value());
          world_.model.CreateAnswered(tags[static_cast<size_t>(i)], tags[static_cast<size_t>(i)], ids.back());
        }
        return ids;
      }
      if (!IsToRepeat("create", made.error())) return {};
      if (world_.bug == PlantedBug::kRetryWithoutRequestId) {
        for (v1::CreateSolveRequest& request : *batch.mutable_requests()) request.clear_request_id();
      }
      Pause();
    }
    return {};
  }

  Outcome<v1::BatchCreateSolvesResponse> CreateAt(ServerLife& life, const v1::BatchCreateSolvesRequest& batch) {
    if (batch.requests_size() > 1) return life.service.BatchCreateSolves(caller_, batch);
    Outcome<v1::Solve> solve = life.service.CreateSolve(caller_, batch.requests(0));
    if (!solve.ok()) return solve.error();
    v1::BatchCreateSolvesResponse response;
    *response.add_solves() = std::move(solve).value();
    return response;
  }

  void Follow(const std::string& id) {
    if (random().Chance(0.3)) Pause();
    if (random().Chance(0.2)) SetPriority(id);
    if (random().Chance(0.35)) Cancel(id);
    const bool is_there = random().Chance(0.7) ? Watch(id) : Poll(id);
    if (is_there && random().Chance(0.3)) Delete(id);
  }

  void Cancel(const std::string& id) {
    while (!world_.over && !random().Chance(0.03)) {
      world_.model.CancelAsked(id);
      const auto answer = Ask("cancel", [&](ServerLife& life) {
        return life.service.CancelSolve(caller_, Named<v1::CancelSolveRequest>(SolveName(id)));
      });
      if (answer.ok()) return world_.model.CancelAnswered(id);
      if (answer.error().code == ErrorCode::kNotFound) world_.model.NotFoundAnswered(id);
      if (!IsToRepeat("cancel", answer.error())) return;
      Pause();
    }
  }

  // Where it runs already there is nothing to change.
  void SetPriority(const std::string& id) {
    v1::SetSolvePriorityRequest request = Named<v1::SetSolvePriorityRequest>(SolveName(id));
    request.set_priority(random().Below(3) - 1);
    const auto answer =
        Ask("set priority", [&](ServerLife& life) { return life.service.SetSolvePriority(caller_, request); });
    if (answer.ok() || answer.error().code == ErrorCode::kFailedPrecondition) return;
    if (answer.error().code == ErrorCode::kNotFound) world_.model.NotFoundAnswered(id);
    IsToRepeat("set priority", answer.error());
  }

  void Delete(const std::string& id) {
    while (!world_.over) {
      world_.model.DeleteAsked(id);
      const auto answer = Ask("delete", [&](ServerLife& life) {
        return life.service.DeleteSolve(caller_, Named<v1::DeleteSolveRequest>(SolveName(id)));
      });
      if (answer.ok()) return world_.model.DeleteAnswered(id);
      if (answer.error().code == ErrorCode::kNotFound) world_.model.NotFoundAnswered(id);
      if (!IsToRepeat("delete", answer.error())) return;
      Pause();
    }
  }

  void Read(const std::string& id, int earlier, const v1::Solve& solve) {
    const std::string result = solve.has_result() ? solve.result().SerializeAsString() : "";
    world_.model.GetAnswered(id, earlier, static_cast<int>(solve.state()), result);
  }

  // Asks again and again until it has ended. False: it is not there any more.
  bool Poll(const std::string& id) {
    while (!world_.over) {
      const int earlier = world_.model.StateOf(id);
      const auto hold = [](int64_t) -> Outcome<Done> { return Done{}; };
      const auto answer = Ask("get", [&](ServerLife& life) {
        return life.service.GetSolve(caller_, Named<v1::GetSolveRequest>(SolveName(id)), hold);
      });
      if (answer.ok()) {
        v1::Solve solve;
        if (!solve.ParseFromString(answer.value().head + answer.value().result)) world_.Complain("a solve is no solve");
        Read(id, earlier, solve);
        if (solve.state() >= v1::SOLVE_STATE_SUCCEEDED) return true;
      } else if (answer.error().code == ErrorCode::kNotFound) {
        world_.model.NotFoundAnswered(id);
        return false;
      } else if (!IsToRepeat("get", answer.error())) {
        return false;
      }
      Pause();
    }
    return false;
  }

  // The same with its events. Each of them comes once, in order, over as many streams as it takes.
  bool Watch(const std::string& id) {
    int64_t after = 0;
    while (!world_.over) {
      const std::shared_ptr<ServerLife> life = world_.server;
      std::optional<bool> is_there;
      if (life != nullptr && !life->process->dead) is_there = Stream(id, *life, &after);
      if (is_there) return *is_there;
      Pause();
    }
    return false;
  }

  // One stream. nullopt: it broke, and is to be opened again.
  std::optional<bool> Stream(const std::string& id, ServerLife& life, int64_t* after) {
    world_.scheduler.Note("opens a stream after " + std::to_string(*after));
    try {
      const Scheduler::ActorId self = world_.scheduler.current();
      const auto opened = life.hub.Open({id, *after, 0}, [this, self] { world_.scheduler.Wake(self); });
      if (!opened.ok()) return Broken(id, opened.error(), after);
      while (!world_.over && !life.process->dead) {
        const Outcome<WatchBatch> batch = opened.value()->Take();
        if (!batch.ok()) return Broken(id, batch.error(), after);
        for (const EventPtr& event : batch.value().events) {
          world_.model.Delivered(id, *after, {event->sequence(), WordsOf(*event)});
          *after = event->sequence();
          if (event->has_finished()) Read(id, 0, event->finished());
        }
        if (batch.value().ended) return true;
        if (!world_.is_calm() && random().Chance(world_.plan.answer_loss / 3)) return std::nullopt;
        if (batch.value().events.empty()) world_.scheduler.Sleep(2 * kSecond);
      }
    } catch (const Crashed&) {
    }
    return std::nullopt;
  }

  std::optional<bool> Broken(const std::string& id, const Error& error, int64_t* after) {
    if (error.code == ErrorCode::kNotFound) {
      world_.model.NotFoundAnswered(id);
      return false;
    }
    if (error.code == ErrorCode::kOutOfRange) {
      const int64_t oldest = world_.model.TrimmedOf(id);
      if (*after >= oldest) world_.Complain("a reader is refused events that are held: " + error.message);
      *after = oldest;
      return std::nullopt;
    }
    if (!IsToRepeat("watch", error)) return false;
    return std::nullopt;
  }

  World& world_;
  const std::string name_;
  Caller caller_;
};

}  // namespace

void LiveAsClient(World& world, int number) {
  Client(world, number).Run();
  --world.clients_at_work;
}

}  // namespace rollgait::server
