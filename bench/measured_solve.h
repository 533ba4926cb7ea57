#ifndef ROLLGAIT_BENCH_MEASURED_SOLVE_H_
#define ROLLGAIT_BENCH_MEASURED_SOLVE_H_

#include <ctime>

#include "core/gait/gait_solver.h"

namespace rollgait {

struct MeasuredSolve {
  GaitSolution solution;
  double cpu = 0;      // s, of the whole solve
  int iterations = 0;  // of all programs
};

// solve() returns a GaitSolution.
template <typename Solve>
MeasuredSolve Measure(Solve solve) {
  MeasuredSolve measured;
  const std::clock_t begin = std::clock();
  measured.solution = solve();
  measured.cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  for (const MeshStatistics& mesh : measured.solution.meshes) measured.iterations += mesh.iterations;
  return measured;
}

}  // namespace rollgait

#endif  // ROLLGAIT_BENCH_MEASURED_SOLVE_H_
