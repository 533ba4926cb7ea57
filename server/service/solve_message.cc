#include "server/service/solve_message.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <utility>

namespace rollgait::server {
namespace {

constexpr char kPrefix[] = "solves/";

void SetTime(int64_t time_us, google::protobuf::Timestamp* time) {
  time->set_seconds(time_us / 1'000'000);
  time->set_nanos(static_cast<int32_t>(time_us % 1'000'000) * 1000);
}

Error Unreadable(const std::string& what, const std::string& id) {
  return {ErrorCode::kInternal, "the stored " + what + " of solves/" + id + " cannot be read"};
}

}  // namespace

std::string SolveName(const std::string& id) { return kPrefix + id; }

Outcome<std::string> SolveId(const std::string& name) {
  const size_t length = sizeof(kPrefix) - 1;
  if (name.size() > length && name.compare(0, length, kPrefix) == 0) return name.substr(length);
  return Error{ErrorCode::kNotFound, "there is no solve \"" + name.substr(0, 100) +
                                         "\"; names have the form solves/{id}, ListSolves lists them"};
}

Outcome<v1::Solve> ToSolve(const SolveRecord& record) {
  v1::Solve solve;
  solve.set_name(SolveName(record.id));
  if (!solve.mutable_spec()->ParseFromString(record.spec)) return Unreadable("spec", record.id);
  solve.set_state(static_cast<v1::SolveState>(record.state));
  SetTime(record.create_time_us, solve.mutable_create_time());
  if (record.start_time_us != 0) SetTime(record.start_time_us, solve.mutable_start_time());
  if (record.end_time_us != 0) SetTime(record.end_time_us, solve.mutable_end_time());
  if (!record.result.empty()) {
    v1::SolveResult* result = IsTerminal(record.state) ? solve.mutable_result() : solve.mutable_intermediate();
    if (!result->ParseFromString(record.result)) return Unreadable("result", record.id);
  }
  if (!record.error.empty() && !solve.mutable_error()->ParseFromString(record.error)) {
    return Unreadable("error", record.id);
  }
  if (record.state == SolveState::kSucceeded) {
    solve.mutable_outcome()->set_termination(static_cast<v1::Termination>(record.termination));
    solve.mutable_outcome()->set_verdict(static_cast<v1::Verdict>(record.verdict));
  }
  solve.set_attempts(record.attempts);
  solve.set_from_cache(record.from_cache);
  solve.set_last_sequence(record.last_sequence);
  solve.set_tenant(record.tenant);
  solve.set_priority(record.priority);
  for (const auto& [key, value] : record.labels) (*solve.mutable_labels())[key] = value;
  return solve;
}

Outcome<SolveBytes> ToSolveBytes(SolveRecord record) {
  SolveBytes bytes;
  bytes.result = std::exchange(record.result, {});
  const Outcome<v1::Solve> rest = ToSolve(record);
  if (!rest.ok()) return rest.error();
  bytes.head = rest.value().SerializeAsString();
  if (bytes.result.empty()) return bytes;
  constexpr uint32_t kLengthDelimited = 2;
  const uint32_t field = IsTerminal(record.state) ? v1::Solve::kResultFieldNumber : v1::Solve::kIntermediateFieldNumber;
  {  // the streams end, and with them the head, before it is moved
    google::protobuf::io::StringOutputStream stream(&bytes.head);
    google::protobuf::io::CodedOutputStream coded(&stream);
    coded.WriteTag(field << 3 | kLengthDelimited);
    coded.WriteVarint32(static_cast<uint32_t>(bytes.result.size()));
  }
  return bytes;
}

Outcome<v1::SolveEvent> ToEvent(const std::string& id, const StoredEvent& event) {
  v1::SolveEvent message;
  if (!message.ParseFromString(event.payload)) {
    return Unreadable("event " + std::to_string(event.sequence), id);
  }
  message.set_sequence(event.sequence);
  message.set_name(SolveName(id));
  return message;
}

std::vector<EventPtr> MergeIterations(const std::vector<EventPtr>& all) {
  const auto is_iterate = [](const EventPtr& event) { return event->has_iterate(); };
  const auto newest = std::find_if(all.rbegin(), all.rend(), is_iterate);
  std::vector<EventPtr> events;
  for (const EventPtr& event : all) {
    if (!is_iterate(event) || event == *newest) events.push_back(event);
  }
  std::vector<EventPtr> merged;
  int skipped = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    const bool run_goes_on = events[i]->has_iteration() && i + 1 < events.size() && events[i + 1]->has_iteration();
    if (run_goes_on) {
      skipped += 1 + events[i]->skipped_count();
    } else if (skipped > 0) {
      auto last = std::make_shared<v1::SolveEvent>(*events[i]);
      last->set_skipped_count(last->skipped_count() + skipped);
      merged.push_back(std::move(last));
      skipped = 0;
    } else {
      merged.push_back(events[i]);
    }
  }
  return merged;
}

}  // namespace rollgait::server
