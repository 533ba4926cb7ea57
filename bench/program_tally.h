#ifndef ROLLGAIT_BENCH_PROGRAM_TALLY_H_
#define ROLLGAIT_BENCH_PROGRAM_TALLY_H_

#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "core/gait/gait_solver.h"

namespace rollgait {

// What the programs of many solves took, by where they started; CPU time follows iterations times intervals.
class ProgramTally {
 public:
  // The programs of one solve, in their order.
  void Add(const std::vector<MeshStatistics>& programs) {
    int before = 0;
    for (const MeshStatistics& program : programs) {
      const int intervals = std::accumulate(program.intervals.begin(), program.intervals.end(), 0);
      Row& row = rows_[Kind(program.start, before, intervals)];
      ++row.programs;
      row.iterations += program.iterations;
      work_ += static_cast<long>(program.iterations) * intervals;
      before = intervals;
    }
  }
  void Print() const {
    std::printf("%-36s %8s %10s %6s\n", "programs that started from", "programs", "iterations", "each");
    for (const auto& [kind, row] : rows_) {
      std::printf("%-36s %8d %10d %6.1f\n", kind.c_str(), row.programs, row.iterations,
                  static_cast<double>(row.iterations) / row.programs);
    }
    std::printf("iterations times intervals: %ld\n", work_);
  }

 private:
  struct Row {
    int programs = 0, iterations = 0;
  };

  static std::string Kind(StartOf start, int before, int intervals) {
    switch (start) {
      case StartOf::kGuess:
        return "a guess";
      case StartOf::kNeighbour:
        return "a neighbour";
      case StartOf::kSmoother:
        return "smoother powers";
      case StartOf::kOtherRequest:
        return "another request";
      case StartOf::kImage:
        return "one step and its image";
      case StartOf::kSameMesh:
        return "the same mesh";
      case StartOf::kFinerMesh:
        break;
    }
    const double growth = before > 0 ? static_cast<double>(intervals - before) / before : 1;
    return std::string("a coarser mesh, intervals new: ") + (growth < 0.05 ? "<5%" : growth < 0.2 ? "<20%" : "more");
  }

  std::map<std::string, Row> rows_;
  long work_ = 0;
};

}  // namespace rollgait

#endif  // ROLLGAIT_BENCH_PROGRAM_TALLY_H_
