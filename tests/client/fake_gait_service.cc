#include "tests/client/fake_gait_service.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <iterator>
#include <utility>

#include "tests/client/fake_filter.h"
#include "tests/client/fake_refusal.h"
#include "tests/client/sample_accuracy.h"
#include "tests/client/sample_solve.h"

namespace rollgait::client {
namespace {

grpc::Status NotFound(const std::string& name) { return {grpc::StatusCode::NOT_FOUND, "no solve is called " + name}; }

v1::SolveEvent NewEvent(const std::string& name, int64_t sequence) {
  v1::SolveEvent event;
  event.set_name(name);
  event.set_sequence(sequence);
  return event;
}

}  // namespace

void FakeGaitService::BreakAfter(std::multiset<int64_t> sequences) {
  std::lock_guard<std::mutex> lock(mutex_);
  breaks_ = std::move(sequences);
}

std::vector<v1::CreateSolveRequest> FakeGaitService::created() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return created_;
}
std::vector<v1::WatchSolveRequest> FakeGaitService::watched() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return watched_;
}
std::vector<v1::WatchSolvesRequest> FakeGaitService::watched_together() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return watched_together_;
}
std::vector<v1::ListSolvesRequest> FakeGaitService::listed() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return listed_;
}
std::vector<std::string> FakeGaitService::cancelled() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return cancelled_;
}
std::vector<std::string> FakeGaitService::deleted() const {
  std::lock_guard<std::mutex> lock(mutex_);
  return deleted_;
}

void FakeGaitService::Finish(Record& record, v1::SolveState state) {
  const int64_t sequence = static_cast<int64_t>(record.events.size()) + 1;
  record.solve.set_state(state);
  record.solve.set_last_sequence(sequence);
  v1::SolveEvent event = NewEvent(record.solve.name(), sequence);
  *event.mutable_finished() = record.solve;
  record.events.push_back(event);
}

grpc::Status FakeGaitService::CreateSolve(grpc::ServerContext*, const v1::CreateSolveRequest* request,
                                          v1::Solve* solve) {
  std::lock_guard<std::mutex> lock(mutex_);
  return Create(*request, request->spec().model().name(), solve);
}

grpc::Status FakeGaitService::BatchCreateSolves(grpc::ServerContext*, const v1::BatchCreateSolvesRequest* request,
                                                v1::BatchCreateSolvesResponse* response) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (busy_s_ > 0) return Busy(std::exchange(busy_s_, 0));
  if (request->requests_size() > batch_limit_) {
    return {grpc::StatusCode::INVALID_ARGUMENT, "requests[0].spec makes it too long; send it in several batches"};
  }
  for (const v1::CreateSolveRequest& one : request->requests()) {
    const auto known = by_request_id_.find(one.request_id());
    if (known != by_request_id_.end()) {
      *response->add_solves() = records_[known->second].solve;
      continue;
    }
    const std::string id = one.spec().model().name() + std::to_string(std::lround(one.spec().slope_rad() * 180 / M_PI));
    const grpc::Status status = Create(one, id, response->add_solves());
    if (!status.ok()) return status;
    by_request_id_[one.request_id()] = "solves/" + id;
  }
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::Create(const v1::CreateSolveRequest& request, const std::string& id, v1::Solve* solve) {
  created_.push_back(request);
  const std::string& model = request.spec().model().name();
  if (model == "refused") {
    return Refusal(
        {{"slope_rad", "is 0.873, must be in [-0.785, 0.785]"}, {"motion.speed_m_s", "is 9, must be in (0, 4]"}});
  }
  if (model != "planar" && model != "infeasible" && model != "crash" && model != "endless" && model != "inaccurate" &&
      model != "draft") {
    return Refusal({{"model.name", "is \"" + model + "\", must be one of planar"}});
  }
  Record record;
  record.solve = SampleSolve("solves/" + id, request.spec().slope_rad());
  *record.solve.mutable_spec() = request.spec();
  *record.solve.mutable_labels() = request.labels();
  if (!request.spec().warm_start().empty()) {
    record.solve.mutable_result()->mutable_warm_started_from()->set_name(request.spec().warm_start());
  }
  record.solve.set_priority(request.priority());
  v1::SolveEvent running = NewEvent(record.solve.name(), 1);
  running.mutable_state_change()->set_state(v1::SOLVE_STATE_RUNNING);
  running.mutable_state_change()->set_attempt(1);
  record.events.push_back(running);
  for (int i = 0; i < iterations_; ++i) {
    v1::SolveEvent event = NewEvent(record.solve.name(), i + 2);
    event.mutable_iteration()->set_index(i);
    event.mutable_iteration()->set_objective(1000.0 - i);
    event.mutable_iteration()->set_primal_infeasibility(1e-3);
    event.mutable_iteration()->set_elapsed_s(0.01 * i);
    record.events.push_back(event);
  }
  record.solve.set_state(v1::SOLVE_STATE_RUNNING);
  if (model == "endless" || model == "crash") record.solve.clear_outcome();
  if (model == "inaccurate") Exceed(record.solve, "max_slip_m_s", 20);
  if (model == "draft") {
    record.solve.mutable_result()->mutable_accuracy()->set_verdict(v1::VERDICT_NOT_JUDGED);
    record.solve.mutable_outcome()->set_verdict(v1::VERDICT_NOT_JUDGED);
  }
  if (model == "infeasible") {
    v1::SolveResult& result = *record.solve.mutable_result();
    result.set_termination(v1::TERMINATION_INFEASIBLE);
    record.solve.mutable_outcome()->set_termination(result.termination());
    result.set_message("A local minimum of infeasibility.");
    v1::UnmetConstraint& unmet = *result.add_unmet_constraints();
    unmet.set_name("rolling left_foot");
    unmet.set_violation(0.25);
    unmet.set_unit("m/s");
  }
  if (model == "crash") {
    record.solve.clear_result();
    record.solve.mutable_error()->set_kind(v1::SolveError::KIND_CRASH);
    record.solve.mutable_error()->set_message("the solver died three times");
  }
  if (model == "crash") Finish(record, v1::SOLVE_STATE_FAILED);
  if (model != "crash" && model != "endless") Finish(record, v1::SOLVE_STATE_SUCCEEDED);
  *solve = record.solve;
  solve->clear_result();
  if (request.validate_only()) {
    solve->clear_name();
    if (spells_out_ && request.spell_out() && solve->spec().preset() != v1::PRESET_UNSPECIFIED) {
      solve->mutable_spec()->clear_preset();
      solve->mutable_spec()->add_costs()->mutable_muscle_effort();
    }
    return grpc::Status::OK;
  }
  records_[record.solve.name()] = record;
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::WatchSolve(grpc::ServerContext* context, const v1::WatchSolveRequest* request,
                                         grpc::ServerWriter<v1::SolveEvent>* writer) {
  std::unique_lock<std::mutex> lock(mutex_);
  watched_.push_back(*request);
  if (records_.count(request->name()) == 0) return NotFound(request->name());
  for (size_t next = static_cast<size_t>(request->after_sequence()); !context->IsCancelled();) {
    Record& record = records_[request->name()];
    if (next >= record.events.size()) {
      writer->Write([&] {
        v1::SolveEvent heartbeat = NewEvent(request->name(), static_cast<int64_t>(next));
        heartbeat.mutable_heartbeat();
        return heartbeat;
      }());
      if (request->iterates_per_second() > 0) writer->Write(IterateOf(*request, static_cast<int64_t>(next)));
      changed_.wait_for(lock, std::chrono::milliseconds(20));
      continue;
    }
    const v1::SolveEvent event = record.events[next++];
    writer->Write(event);
    if (event.has_finished()) return grpc::Status::OK;
    const auto broken = breaks_.find(event.sequence());
    if (broken != breaks_.end()) {
      breaks_.erase(broken);
      return {broken_++ % 2 == 0 ? grpc::StatusCode::UNAVAILABLE : grpc::StatusCode::CANCELLED, "broken by the test"};
    }
  }
  return grpc::Status::CANCELLED;
}

v1::SolveEvent FakeGaitService::IterateOf(const v1::WatchSolveRequest& request, int64_t sequence) {
  v1::SolveEvent event = NewEvent(request.name(), sequence);
  *event.mutable_iterate() = SampleIterate(SampleModel(), 4, 0);
  return event;
}

grpc::Status FakeGaitService::WatchSolves(grpc::ServerContext* context, const v1::WatchSolvesRequest* request,
                                          grpc::ServerWriter<v1::SolveEvent>* writer) {
  std::unique_lock<std::mutex> lock(mutex_);
  watched_together_.push_back(*request);
  std::map<std::string, int64_t> after;
  for (const v1::WatchSolveRequest& one : request->solves()) {
    if (records_.count(one.name()) == 0) return NotFound(one.name());
    after[one.name()] = one.after_sequence();
  }
  while (!after.empty() && !context->IsCancelled()) {
    bool news = false;
    for (auto one = after.begin(); one != after.end();) {
      const std::vector<v1::SolveEvent>& events = records_[one->first].events;
      if (one->second >= static_cast<int64_t>(events.size())) {
        ++one;
        continue;
      }
      news = true;
      const v1::SolveEvent event = events[static_cast<size_t>(one->second++)];
      writer->Write(event);
      one = event.has_finished() ? after.erase(one) : std::next(one);
      const auto broken = breaks_.find(event.sequence());
      if (broken == breaks_.end()) continue;
      breaks_.erase(broken);
      return {grpc::StatusCode::UNAVAILABLE, "broken by the test"};
    }
    if (!news) changed_.wait_for(lock, std::chrono::milliseconds(20));
  }
  return after.empty() ? grpc::Status::OK : grpc::Status::CANCELLED;
}

grpc::Status FakeGaitService::GetSolve(grpc::ServerContext*, const v1::GetSolveRequest* request, v1::Solve* solve) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = records_.find(request->name());
  if (found == records_.end()) return NotFound(request->name());
  *solve = found->second.solve;
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::ListSolves(grpc::ServerContext*, const v1::ListSolvesRequest* request,
                                         v1::ListSolvesResponse* response) {
  std::lock_guard<std::mutex> lock(mutex_);
  listed_.push_back(*request);
  // One solve a page, so that the client has to turn pages; the token is the name to go on with.
  for (auto& [name, record] : records_) {
    if (name < request->page_token()) continue;
    if (!Passes(record.solve, *request)) continue;
    if (response->solves_size() == 1) {
      response->set_next_page_token(name);
      break;
    }
    *response->add_solves() = record.solve;
    response->mutable_solves(0)->clear_result();
  }
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::CancelSolve(grpc::ServerContext*, const v1::CancelSolveRequest* request,
                                          v1::Solve* solve) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = records_.find(request->name());
  if (found == records_.end()) return NotFound(request->name());
  cancelled_.push_back(request->name());
  if (found->second.solve.state() == v1::SOLVE_STATE_RUNNING) {
    found->second.solve.clear_result();
    found->second.solve.mutable_error()->set_kind(v1::SolveError::KIND_CANCELLED);
    Finish(found->second, v1::SOLVE_STATE_CANCELLED);
  }
  *solve = found->second.solve;
  changed_.notify_all();
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::SetSolvePriority(grpc::ServerContext*, const v1::SetSolvePriorityRequest* request,
                                               v1::Solve* solve) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = records_.find(request->name());
  if (found == records_.end()) return NotFound(request->name());
  found->second.solve.set_priority(request->priority());
  *solve = found->second.solve;
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::DeleteSolve(grpc::ServerContext*, const v1::DeleteSolveRequest* request,
                                          google::protobuf::Empty*) {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto found = records_.find(request->name());
  if (found == records_.end()) return NotFound(request->name());
  if (found->second.solve.state() == v1::SOLVE_STATE_RUNNING) {
    return {grpc::StatusCode::FAILED_PRECONDITION, "the solve is running"};
  }
  records_.erase(found);
  deleted_.push_back(request->name());
  return grpc::Status::OK;
}

// The stored ones on pages of one.
grpc::Status FakeGaitService::ListModels(grpc::ServerContext*, const v1::ListModelsRequest* request,
                                         v1::ListModelsResponse* response) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (request->page_token().empty()) *response->add_models() = SampleModel().summary();
  const size_t page = request->page_token().empty() ? 0 : std::stoul(request->page_token());
  if (page < models_.size()) *response->add_models() = models_[page];
  if (page + 1 < models_.size()) response->set_next_page_token(std::to_string(page + 1));
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::CreateModel(grpc::ServerContext*, const v1::CreateModelRequest* request,
                                          v1::Model* model) {
  std::lock_guard<std::mutex> lock(mutex_);
  *model = request->model();
  const std::string id = request->model_id().empty() ? model->summary().name() : request->model_id();
  model->mutable_summary()->mutable_stored()->set_name("models/" + id + "@1");
  models_.push_back(model->summary());
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::DeleteModel(grpc::ServerContext*, const v1::DeleteModelRequest* request,
                                          google::protobuf::Empty*) {
  std::lock_guard<std::mutex> lock(mutex_);
  const size_t removed = std::erase_if(
      models_, [&](const v1::ModelSummary& model) { return model.stored().name() == request->name() + "@1"; });
  return removed > 0 ? grpc::Status::OK : NotFound(request->name());
}

grpc::Status FakeGaitService::GetModel(grpc::ServerContext*, const v1::GetModelRequest* request, v1::Model* model) {
  if (request->model().name() != "planar" && request->model().name() != "endless")
    return {grpc::StatusCode::NOT_FOUND, "no such model"};
  *model = SampleModel();
  *model->mutable_selection() = request->model();
  for (v1::Joint& joint : *model->mutable_joints()) {
    const auto spring = request->model().joint_springs().find(joint.name());
    if (spring == request->model().joint_springs().end()) continue;
    joint.set_stiffness(spring->second.stiffness_n_m_rad());
    joint.set_rest_position(spring->second.rest_rad());
    joint.set_damping(spring->second.damping_n_m_s_rad());
  }
  return grpc::Status::OK;
}

grpc::Status FakeGaitService::GetServerInfo(grpc::ServerContext*, const v1::GetServerInfoRequest*,
                                            v1::ServerInfo* info) {
  info->set_version("1.2.3");
  info->set_solver_slots(2);
  info->set_store("sqlite");
  info->mutable_server_time()->set_seconds(std::time(nullptr));
  info->set_max_queued(100);
  info->set_store_free_bytes(int64_t{5} << 30);
  return grpc::Status::OK;
}

}  // namespace rollgait::client
