#include "client/list_filter.h"

#include <charconv>
#include <ctime>

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

WallClock::time_point ParseSince(const std::string& text, WallClock::time_point now) {
  if (const std::optional<std::chrono::seconds> age = ParseAge(text)) return now - *age;
  if (const std::optional<WallClock::time_point> date = ParseDate(text)) return *date;
  throw Failure(ExitCode::kUsage, "--since " + text +
                                      ": must be an age, for example 90s, 30m, 12h or 7d, or a UTC date, for example "
                                      "2026-11-24 or 2026-11-24T12:30");
}

std::string ListedModel(const v1::Solve& solve) {
  const v1::ModelSelection& model = solve.spec().model();
  return model.has_own() ? "own" : model.name();
}

SolveMatcher::SolveMatcher(const ListFilter& filter, WallClock::time_point now) : model_(filter.model) {
  if (!filter.state.empty()) state_ = Lookup("--state", filter.state, StateWords());
  if (!filter.verdict.empty()) verdict_ = Lookup("--verdict", filter.verdict, VerdictWords());
  if (!filter.termination.empty()) termination_ = Lookup("--termination", filter.termination, TerminationWords());
  if (!filter.name_prefix.empty()) name_prefix_ = SolveName(filter.name_prefix);
  if (!filter.since.empty()) since_ = ParseSince(filter.since, now);
}

bool SolveMatcher::IsOfStateAlone() const {
  return !verdict_ && !termination_ && !since_ && model_.empty() && name_prefix_.empty();
}

bool SolveMatcher::Matches(const v1::Solve& solve) const {
  if (state_ != v1::SOLVE_STATE_UNSPECIFIED && solve.state() != state_) return false;
  // As it is shown: an outcome without a verdict, of an old version, was not judged.
  const bool silent = solve.has_outcome() && solve.outcome().verdict() == v1::VERDICT_UNSPECIFIED;
  if (verdict_ && (silent ? v1::VERDICT_NOT_JUDGED : solve.outcome().verdict()) != *verdict_) return false;
  if (termination_ && solve.outcome().termination() != *termination_) return false;
  if (!model_.empty() && ListedModel(solve) != model_) return false;
  if (solve.name().rfind(name_prefix_, 0) != 0) return false;
  return !IsTooOld(solve);
}

bool SolveMatcher::IsTooOld(const v1::Solve& solve) const {
  if (!since_) return false;
  const auto created =
      std::chrono::seconds(solve.create_time().seconds()) +
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::nanoseconds(solve.create_time().nanos()));
  return WallClock::time_point(std::chrono::duration_cast<WallClock::duration>(created)) < *since_;
}

}  // namespace rollgait::client
