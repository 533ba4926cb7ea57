// The grid of a sweep: some flags of a request take several values.
#ifndef ROLLGAIT_CLIENT_SWEEP_GRID_H_
#define ROLLGAIT_CLIENT_SWEEP_GRID_H_

#include <optional>
#include <string>
#include <vector>

#include "client/spec_flags.h"

namespace rollgait::client {

// A flag that may take several values in a sweep.
struct SweepAxis {
  std::string flag;    // "--slope"
  std::string column;  // in tables: "slope_deg"
  std::optional<double> SpecFlags::*value;
  std::string help;
};
// In the order in which points are laid out: the last one changes fastest.
const std::vector<SweepAxis>& SweepAxes();

struct SweepPoint {
  std::vector<double> values;  // of the axes that the sweep has
  std::string name;            // "slope_-5_speed_1.2": a file's name without its ending
};

struct SweepGrid {
  std::vector<SweepAxis> axes;  // those that values were given for
  std::vector<SweepPoint> points;
};

// Most points of a grid: what a server lets wait by default.
inline constexpr size_t kMostPoints = 1000;

// Of "-10:10:2.5", from the first to the last in steps, of "0.8,1,1.3", or of one number. The last value of a range is
// taken if a whole number of steps leads there but for rounding. Throws Failure(kUsage), which names the flag.
std::vector<double> ParseSweepValues(const std::string& flag, const std::string& text);

// All combinations. `texts` belong to SweepAxes(); an empty one is no axis. Throws Failure(kUsage), also if there is
// none or there are more points than kMostPoints.
SweepGrid MakeGrid(const std::vector<std::string>& texts);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SWEEP_GRID_H_
