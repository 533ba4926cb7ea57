#ifndef ROLLGAIT_TESTS_SERVER_SERVICE_SERVICE_FIXTURE_H_
#define ROLLGAIT_TESTS_SERVER_SERVICE_SERVICE_FIXTURE_H_

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/base/clock.h"
#include "server/base/data_dir.h"
#include "server/base/notify.h"
#include "server/service/solve_service.h"
#include "server/service/watch_hub.h"
#include "server/store/open_store.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {

// Knows one model, "planar", own ones that weigh something, and slopes up to 0.5 rad: the service without the physics.
inline GaitKnowledge SmallKnowledge() {
  GaitKnowledge knowledge;
  knowledge.check_spec = [](const v1::SolveSpec& spec) -> Result<v1::Model> {
    Violations violations;
    if (spec.model().name() != "planar" && !spec.model().has_own())
      violations.push_back({"model.name", "is not a model"});
    if (spec.slope_rad() > 0.5) violations.push_back({"slope_rad", "is too steep, the limit is 0.5"});
    if (!violations.empty()) return violations;
    if (spec.model().has_own()) return spec.model().own();
    v1::Model model;
    model.mutable_summary()->set_name("planar");
    return model;
  };
  knowledge.check_warm_start = [](const v1::SolveSpec& spec, const v1::SolveResult& result) {
    return spec.slope_rad() < result.objective() ? Violations()
                                                 : Violations{{"warm_start", "its solution is of another world"}};
  };
  knowledge.list_models = [] {
    v1::ListModelsResponse response;
    response.add_models()->set_name("planar");
    return response;
  };
  knowledge.get_model = [](const v1::ModelSelection& selection) -> Result<v1::Model> {
    if (selection.stature_m() > 2.3) return Violations{{"stature_m", "is too large, the limit is 2.3"}};
    v1::Model model;
    if (selection.has_own()) {
      if (selection.has_stature_m()) return Violations{{"stature_m", "is not of an own model"}};
      model = selection.own();
      if (model.joints_size() == 0) return Violations{{"own.joints", "are 0, at least 1 is needed"}};
      if (model.joints(0).mass_kg() <= 0) return Violations{{"own.joints[0].mass_kg", "is not above 0"}};
      model.set_total_mass_kg(model.joints(0).mass_kg());  // completed
      return model;
    }
    *model.mutable_selection() = selection;
    return model;
  };
  knowledge.spell_out = [](v1::SolveSpec spec) -> Result<v1::SolveSpec> {
    if (spec.preset() == v1::PRESET_TORQUE) spec.add_costs()->mutable_squared_torque();
    spec.clear_preset();
    return spec;
  };
  return knowledge;
}

// Of the answers' budget: all of it, or nothing.
inline const auto kHoldAll = [](int64_t) -> Outcome<Done> { return Done{}; };
inline const auto kHoldNone = [](int64_t) -> Outcome<Done> { return Error{ErrorCode::kResourceExhausted, "no room"}; };

inline Caller CallerOf(const std::string& tenant, unsigned scopes = kScopeRead | kScopeSolve) {
  Caller caller;
  caller.authentication = Authentication::kToken;
  caller.tenant = tenant;
  caller.scopes = scopes;
  return caller;
}

// A request that names a solve or a model and says nothing else.
template <typename Request>
Request Named(const std::string& name) {
  Request request;
  request.set_name(name);
  return request;
}

inline v1::SolveSpec PlanarSpec(double slope = 0.1) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_slope_rad(slope);
  return spec;
}

// Service, hub and store in a new directory. The test plays the agent through store() and Hint().
class ServiceBench {
 public:
  explicit ServiceBench(std::chrono::milliseconds heartbeat = std::chrono::hours(1), ServiceOptions options = {})
      : store_(OpenStore({directory_.path() + "/rollgait.db"}, clock_).value()),
        channel_(SocketHints::Create(directory_.path(), kServerSocket, kAgentSocket).value()),
        iterates_(directory_.path() + "/iterates"),
        hub_(*store_, *channel_, heartbeat, iterates_),
        hints_(NotifySender::Create(directory_.path(), kServerSocket).value()),
        service_(*store_, *store_, SmallKnowledge(), std::move(options),
                 [this](const std::string& id) { hub_.Changed(id); }) {}

  SqlStore& store() { return *store_; }
  WatchHub& hub() { return hub_; }
  SolveService& service() { return service_; }
  const IterateFiles& iterates() const { return iterates_; }
  void Hint(const std::string& id) { hints_.Send(id); }

  // The id of a new solve.
  std::string Create(const v1::SolveSpec& spec = PlanarSpec()) {
    v1::CreateSolveRequest request;
    *request.mutable_spec() = spec;
    return service_.CreateSolve({}, request).value().name().substr(sizeof("solves/") - 1);
  }
  Lease Claim() { return store_->ClaimNext("agent", kLeaseDuration).value().value().lease; }
  void AppendIterations(const Lease& lease, int first, int count) {
    std::vector<StoredEvent> events;
    for (int i = first; i < first + count; ++i) {
      v1::SolveEvent event;
      event.mutable_iteration()->set_index(i);
      event.mutable_iteration()->set_objective(1.0 / (1 + i));
      events.push_back({0, EventKind::kIteration, event.SerializeAsString()});
    }
    ROLLGAIT_CHECK(store_->AppendEvents(lease, events).ok());
    Hint(lease.solve_id);
  }
  void Finish(const Lease& lease, const std::string& message = "found") {
    v1::SolveResult result;
    result.set_termination(v1::TERMINATION_OPTIMAL);
    result.set_message(message);
    ROLLGAIT_CHECK(store_->Finish(lease, {}, {SolveState::kSucceeded, result.SerializeAsString(), "", true}).ok());
    Hint(lease.solve_id);
  }

 private:
  TemporaryDirectory directory_;
  SystemClock clock_;
  std::unique_ptr<SqlStore> store_;
  std::unique_ptr<HintChannel> channel_;
  IterateFiles iterates_;
  WatchHub hub_;
  NotifySender hints_;
  SolveService service_;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_TESTS_SERVER_SERVICE_SERVICE_FIXTURE_H_
