#include "client/list_filter.h"

#include <charconv>
#include <ctime>
#include <optional>

#include "client/failure.h"
#include "client/flag_values.h"
#include "client/spec_words.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using WallClock = std::chrono::system_clock;

// Of "12h"; nullopt: not an age. At most a hundred years.
std::optional<std::chrono::seconds> ParseAge(const std::string& text) {
  if (text.size() < 2) return std::nullopt;
  int64_t count = 0;
  const char* const end = text.data() + text.size() - 1;
  const auto parsed = std::from_chars(text.data(), end, count);
  const char unit = text.back();
  const int64_t seconds = unit == 's' ? 1 : unit == 'm' ? 60 : unit == 'h' ? 3600 : unit == 'd' ? 86400 : 0;
  constexpr int64_t kLongest_s = int64_t{100} * 366 * 86400;
  if (parsed.ec != std::errc() || parsed.ptr != end || seconds == 0 || count < 0 || count > kLongest_s / seconds) {
    return std::nullopt;
  }
  return std::chrono::seconds(count * seconds);
}

// Of "2026-11-24" or "2026-11-24T12:30"; nullopt: not a date, 2026-02-31 for example.
std::optional<WallClock::time_point> ParseDate(const std::string& text) {
  for (const char* format : {"%Y-%m-%d", "%Y-%m-%dT%H:%M"}) {
    std::tm time{};
    const char* const end = strptime(text.c_str(), format, &time);
    if (end == nullptr || *end != '\0') continue;
    const std::tm given = time;
    const std::time_t seconds = timegm(&time);
    if (time.tm_mday == given.tm_mday && time.tm_mon == given.tm_mon) return WallClock::from_time_t(seconds);
  }
  return std::nullopt;
}

}  // namespace

WallClock::time_point ParseTime(const std::string& flag, const std::string& text, WallClock::time_point now) {
  if (const std::optional<std::chrono::seconds> age = ParseAge(text)) return now - *age;
  if (const std::optional<WallClock::time_point> date = ParseDate(text)) return *date;
  throw Failure(ExitCode::kUsage, flag + " " + text +
                                      ": must be an age, for example 90s, 30m, 12h or 7d, or a UTC date, for example "
                                      "2026-11-24 or 2026-11-24T12:30");
}

std::string ListedModel(const v1::Solve& solve) {
  const v1::ModelSelection& model = solve.spec().model();
  return model.has_own() ? "own" : model.name();
}

v1::ListSolvesRequest ListRequest(const ListFilter& filter, WallClock::time_point now) {
  v1::ListSolvesRequest request;
  request.set_tenant(filter.tenant);
  for (const std::string& word : filter.states) {
    const v1::SolveState state = Lookup("--state", word, StateWords());
    if (filter.states.size() == 1) {
      request.set_state(state);
    } else {
      request.mutable_filter()->add_states(state);
    }
  }
  if (!filter.verdict.empty()) {
    request.mutable_filter()->set_verdict(Lookup("--verdict", filter.verdict, VerdictWords()));
  }
  if (!filter.termination.empty()) {
    request.mutable_filter()->set_termination(Lookup("--termination", filter.termination, TerminationWords()));
  }
  for (const std::string& label : filter.labels) {
    const auto [key, value] = ParseLabel(label);
    (*request.mutable_filter()->mutable_labels())[key] = value;
  }
  if (!filter.model.empty()) request.mutable_filter()->set_model(filter.model);
  const auto set_time = [&](const std::string& flag, const std::string& text, google::protobuf::Timestamp* time) {
    const auto instant = ParseTime(flag, text, now).time_since_epoch();
    const auto seconds = std::chrono::floor<std::chrono::seconds>(instant);
    time->set_seconds(seconds.count());
    time->set_nanos(static_cast<int32_t>(std::chrono::nanoseconds(instant - seconds).count()));
  };
  if (!filter.since.empty()) {
    set_time("--since", filter.since, request.mutable_filter()->mutable_create_time_from());
  }
  if (!filter.before.empty()) {
    set_time("--before", filter.before, request.mutable_filter()->mutable_create_time_before());
  }
  return request;
}

bool HasNameOf(const ListFilter& filter, const v1::Solve& solve) {
  return filter.name_prefix.empty() || solve.name().rfind(SolveName(filter.name_prefix), 0) == 0;
}

}  // namespace rollgait::client
