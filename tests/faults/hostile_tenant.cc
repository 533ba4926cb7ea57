#include "tests/faults/hostile_tenant.h"

#include <google/protobuf/util/json_util.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace rollgait::faults {
namespace {

using std::chrono::milliseconds;

constexpr int kThreadsOfAKind = 4;
constexpr int kIterations = 200;  // of a solve: two seconds
constexpr int kBatch = 256;
constexpr size_t kDescriptionBytes = 1'900;
constexpr int kUnreadConnections = 4, kUnreadStreams = 1000;

struct Material {
  const v1::Model& model;
  int64_t number;  // another one in each call
};

v1::SolveSpec Spec(int64_t number) {
  v1::SolveSpec spec;
  spec.mutable_model()->set_name("planar");
  spec.set_slope_rad(-1e-9 * static_cast<double>(number % 100'000'000));
  spec.mutable_solver_limits()->set_max_iterations(kIterations);
  return spec;
}

grpc::Status FillQueue(Stub& stub, grpc::ClientContext* context, const Material& with) {
  v1::CreateSolveRequest request;
  *request.mutable_spec() = Spec(with.number);
  v1::Solve solve;
  return stub.CreateSolve(context, request, &solve);
}

v1::BatchCreateSolvesRequest Batch(int64_t number) {
  v1::BatchCreateSolvesRequest request;
  for (int i = 0; i < kBatch; ++i) *request.add_requests()->mutable_spec() = Spec(10'000'000 + number * kBatch + i);
  return request;
}

grpc::Status FillQueueByBatches(Stub& stub, grpc::ClientContext* context, const Material& with) {
  v1::BatchCreateSolvesResponse response;
  return stub.BatchCreateSolves(context, Batch(with.number), &response);
}

grpc::Status ValidateBatches(Stub& stub, grpc::ClientContext* context, const Material& with) {
  v1::BatchCreateSolvesRequest request = Batch(with.number);
  request.set_validate_only(true);
  for (v1::CreateSolveRequest& one : *request.mutable_requests()) {
    one.mutable_spec()->mutable_model()->set_name("human29");
  }
  v1::BatchCreateSolvesResponse response;
  return stub.BatchCreateSolves(context, request, &response);
}

grpc::Status AskForNearest(Stub& stub, grpc::ClientContext* context, const Material& with) {
  v1::BatchCreateSolvesRequest request = Batch(with.number);
  request.set_validate_only(true);
  for (v1::CreateSolveRequest& one : *request.mutable_requests()) {
    one.mutable_spec()->set_warm_start("nearest");
    // Farther from every solve than 5°: the whole index is searched, and the slow solver's results, which have no
    // motion, are not refused.
    one.mutable_spec()->set_slope_rad(one.spec().slope_rad() - 0.2);
  }
  v1::BatchCreateSolvesResponse response;
  return stub.BatchCreateSolves(context, request, &response);
}

grpc::Status FillStorage(Stub& stub, grpc::ClientContext* context, const Material& with) {
  v1::CreateModelRequest request;
  *request.mutable_model() = with.model;
  request.mutable_model()->mutable_summary()->set_description(std::string(kDescriptionBytes, 'd') +
                                                              std::to_string(with.number));
  request.set_model_id("m");
  v1::Model model;
  return stub.CreateModel(context, request, &model);
}

grpc::Status List(Stub& stub, grpc::ClientContext* context, const Material&) {
  v1::ListSolvesRequest request;
  request.set_page_size(1000);
  v1::ListSolvesResponse response;
  return stub.ListSolves(context, request, &response);
}

v1::SimulationScene LongScene() {
  std::ifstream file(ROLLGAIT_SCENES "/ball_bowled.json");
  v1::SimulationScene scene;
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!google::protobuf::util::JsonStringToMessage(text, &scene).ok()) {
    throw std::runtime_error("scenes/ball_bowled.json cannot be read");
  }
  scene.set_duration_s(1'000);
  scene.set_output_step_s(0.001);
  return scene;
}

grpc::Status Simulate(Stub& stub, grpc::ClientContext* context, const Material&) {
  v1::SimulateRequest request;
  *request.mutable_scene() = LongScene();
  const auto stream = stub.Simulate(context, request);
  v1::SimulationMessage message;
  while (stream->Read(&message)) {
  }
  return stream->Finish();
}

struct Kind {
  const char* name;
  grpc::Status (*call)(Stub&, grpc::ClientContext*, const Material&);
};

constexpr std::array kKinds = {Kind{"CreateSolve", FillQueue},
                               Kind{"BatchCreateSolves", FillQueueByBatches},
                               Kind{"validation of batches", ValidateBatches},
                               Kind{"nearest", AskForNearest},
                               Kind{"CreateModel", FillStorage},
                               Kind{"ListSolves", List},
                               Kind{"Simulate", Simulate}};
constexpr char kUnreadName[] = "unread answers";
constexpr std::array kUnread = {"unread_results", "unread_watches"};

}  // namespace

HostileTenant::HostileTenant(Options options)
    : options_(std::move(options)), next_(options_.first_number), counts_(kKinds.size()) {
  v1::GetModelRequest request;
  request.mutable_model()->set_name("planar");
  const grpc::Status status =
      Connect(options_.address)->GetModel(CallAs(options_.token, milliseconds(10'000)).get(), request, &model_);
  if (!status.ok()) throw std::runtime_error("the hostile tenant cannot read a model: " + status.error_message());
}

void HostileTenant::Attack(double seconds) {
  std::vector<std::thread> threads;
  const auto chosen = [this](const std::string& name) { return options_.only.empty() || options_.only == name; };
  for (size_t kind = 0; kind < kKinds.size(); ++kind) {
    if (!chosen(kKinds[kind].name)) continue;
    for (int i = 0; i < kThreadsOfAKind; ++i) threads.emplace_back([this, kind] { Repeat(kind); });
  }
  for (const char* attack : kUnread) {
    if (chosen(kUnreadName)) threads.emplace_back([this, attack, seconds] { LeaveUnread(attack, seconds); });
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  stopping_ = true;
  for (std::thread& thread : threads) thread.join();
}

void HostileTenant::Repeat(size_t kind) {
  const std::unique_ptr<Stub> stub = Connect(options_.address);
  while (!stopping_) {
    const grpc::Status status =
        kKinds[kind].call(*stub, CallAs(options_.token, milliseconds(3'000)).get(), {model_, ++next_});
    // A simulation that runs until its caller goes has been served.
    const bool served = status.ok() || status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED;
    ++(served ? counts_[kind].served : counts_[kind].refused);
    if (status.error_code() == grpc::StatusCode::INVALID_ARGUMENT) {
      // Not an attack but a mistake of this program.
      std::fprintf(stderr, "%s: %s\n", kKinds[kind].name, status.error_message().c_str());
      return;
    }
  }
}

void HostileTenant::LeaveUnread(const std::string& attack, double seconds) {
  const std::string command = "exec /usr/bin/python3 " ROLLGAIT_ATTACKS " " + attack + " --to " + options_.address +
                              " --token " + options_.token_file + " --solve " + options_.solve + " --seconds " +
                              std::to_string(seconds) + " --connections " + std::to_string(kUnreadConnections) +
                              " --streams " + std::to_string(kUnreadStreams);
  FILE* const output = popen(command.c_str(), "r");
  if (output == nullptr) return;
  char line[512] = "";
  const bool told = std::fgets(line, sizeof line, output) != nullptr;
  if (pclose(output) != 0 || !told) return;
  const std::string text = line, key = "\"streams\": ";
  const size_t at = text.find(key);
  if (at != std::string::npos) unread_ += std::stoll(text.substr(at + key.size()));
}

std::vector<HostileTenant::Tally> HostileTenant::tallies() const {
  std::vector<Tally> tallies;
  for (size_t kind = 0; kind < kKinds.size(); ++kind) {
    tallies.push_back({kKinds[kind].name, counts_[kind].served, counts_[kind].refused});
  }
  tallies.push_back({kUnreadName, unread_, 0});
  if (!options_.only.empty())
    std::erase_if(tallies, [this](const Tally& tally) { return tally.name != options_.only; });
  return tallies;
}

}  // namespace rollgait::faults
