#ifndef ROLLGAIT_SERVER_SERVICE_SOLVE_MESSAGE_H_
#define ROLLGAIT_SERVER_SERVICE_SOLVE_MESSAGE_H_

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rollgait/v1/solve.pb.h"
#include "server/base/outcome.h"
#include "server/store/solve_record.h"

namespace rollgait::server {

// "solves/{id}"
std::string SolveName(const std::string& id);
// The id in a name; kNotFound if the name is not of this form.
Outcome<std::string> SolveId(const std::string& name);

// The record as clients see it. kInternal: a blob of the store cannot be read.
Outcome<v1::Solve> ToSolve(const SolveRecord& record);

// The bytes of ToSolve's message in two parts. The result is the record's own, neither read nor copied: it is what is
// long.
struct SolveBytes {
  // Everything else, and at its end the tag and the length of the result or of `intermediate`, if there is one.
  std::string head;
  std::string result;
};
// kInternal: the spec or the error of the record cannot be read.
Outcome<SolveBytes> ToSolveBytes(SolveRecord record);

using EventPtr = std::shared_ptr<const v1::SolveEvent>;

// A stored event as clients see it, except that a terminal event still lacks `finished`. kInternal as above.
Outcome<v1::SolveEvent> ToEvent(const std::string& id, const StoredEvent& event);

// Merges each run of iterations into its last one, whose skipped_count says how many were left out, and leaves out
// iterates before the last one. All else stays.
std::vector<EventPtr> MergeIterations(const std::vector<EventPtr>& events);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SOLVE_MESSAGE_H_
