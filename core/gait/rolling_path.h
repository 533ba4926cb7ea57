#ifndef ROLLGAIT_CORE_GAIT_ROLLING_PATH_H_
#define ROLLGAIT_CORE_GAIT_ROLLING_PATH_H_

#include <optional>
#include <vector>

#include "core/gait/gait_spec.h"
#include "core/models/rolling_ellipsoid.h"
#include "core/transcription/collocation_nlp.h"

namespace rollgait {

// A motion of a rolling body without a chart, at equally spaced instants from start to end. World axes.
struct RollingPath {
  double duration = 0;             // s
  std::vector<Vector3> positions;  // m, centre
  std::vector<Matrix3> rotations;  // body -> world
  std::vector<Vector3> couples;    // N m, on the body
  std::vector<Vector3> forces;     // N, of the ground
};

// A closed loop (ellipse with unit half-axes, times `size`) between start and end, and which way round to turn.
struct Detour {
  double size = 0;        // m; 0: straight
  double direction = 0;   // rad, of the loop's centre as seen from its start
  double sense = 1;       // 1 or −1
  bool long_way = false;  // the rest of the turn by the angle beyond 180°
};

// A path from start to end of the manoeuvre that takes the detour: it rolls like a ball of the body's mean size without
// spin, and turns evenly by what is then missing.
RollingPath SketchPath(const GaitSpec& spec, const Detour& detour, double duration);

// What a trajectory of the scene does.
RollingPath PathOf(const Scene& scene, const Trajectory& trajectory);

// The chart in which the largest |β| of the path is least, of a fixed set of directions; empty if it is above
// kLargestTilt.
std::optional<OrientationChart> ChooseChart(const RollingPath& path);

// The path in a chart: joint positions at its instants (6 × count), angles without jumps. As a guess with differences
// for the velocities; and as the bounds that the manoeuvre puts on both ends in this chart and with these turns.
MatrixX ChartPositions(const RollingPath& path, const OrientationChart& chart);
MotionGuess GuessInChart(const RollingPath& path, const OrientationChart& chart);
Ends EndsInChart(const Manoeuvre& manoeuvre, const RollingPath& path, const OrientationChart& chart);

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_GAIT_ROLLING_PATH_H_
