#include "client/formats/exported_stride.h"

#include "client/formats/ground.h"
#include "client/report/gait_events_data.h"

namespace rollgait::client {

Stride ExportedStride(const v1::Solve& solve) {
  const v1::SolveResult& result = solve.result();
  return BuildStride(result.trajectory(), result.model(), result.gait_events().start_s(), kCycleSteps);
}

std::string DescribeStride(const v1::Solve& solve) {
  const std::string what = solve.spec().has_manoeuvre()       ? "a manoeuvre"
                           : solve.result().has_gait_events() ? "one gait cycle from right heel strike on"
                                                              : "one gait cycle";
  return (solve.name().empty() ? "Rollgait" : solve.name()) + ": " + what + ". " + GroundOf(solve).Describe();
}

}  // namespace rollgait::client
