// How time and memory of a solve grow with the number of intervals: one process for each mesh, cold, draft accuracy.
//   scaling [--model human29] [--preset human] [--slope 0] [--intervals 15,30,60,120,240]
// --intervals are those of single support; double support has half as many. --slope in degrees. Without a preset:
// squared torque with a little rate. Prints the iterations on that mesh and those with the coarser ones before it, the
// objective, CPU time in all, of the nonlinear program alone per iteration, and the peak of resident memory of the
// whole process; then the exponents p of least-squares fits of c N^p.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "core/gait/optimizing_gait_solver.h"

namespace rollgait {
namespace {

struct Sample {
  int intervals = 0, unknowns = 0, optimal = 0;
  int iterations = 0, all_iterations = 0;  // on the mesh asked for; with the coarser ones before it
  double cpu = 0, program_cpu = 0;         // s
  double memory = 0;                       // MB
  double objective = 0;
};

double CpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

Sample Solve(const GaitRequest& request) {
  const Result<GaitSpec> spec = CheckRequest(request);
  if (!spec.ok()) {
    std::fprintf(stderr, "%s: %s\n", spec.violations()[0].field.c_str(), spec.violations()[0].message.c_str());
    std::_Exit(2);
  }
  Sample sample;
  double first = 0;
  SolveControl control;
  control.observer = [&](const IterationInfo& info) {
    if (info.index == 0) first = CpuSeconds();
    sample.program_cpu = CpuSeconds() - first;
  };
  const double begin = CpuSeconds();
  const GaitSolution solution = OptimizingGaitSolver().Solve(spec.value(), control);
  sample.cpu = CpuSeconds() - begin;
  for (const int count : solution.meshes.back().intervals) sample.intervals += count;
  sample.unknowns = solution.meshes.back().unknowns;
  sample.iterations = solution.meshes.back().iterations;
  for (const MeshStatistics& mesh : solution.meshes) sample.all_iterations += mesh.iterations;
  sample.objective = solution.objective;
  sample.optimal = solution.termination == Termination::kOptimal ? 1 : 0;
  return sample;
}

// In a process of its own, whose peak of memory is that of this solve.
Sample SolveApart(const GaitRequest& request) {
  int ends[2];
  if (pipe(ends) != 0) std::exit(1);
  const pid_t child = fork();
  if (child == 0) {
    const Sample sample = Solve(request);
    std::_Exit(write(ends[1], &sample, sizeof sample) == sizeof sample ? 0 : 1);
  }
  close(ends[1]);
  Sample sample;
  const bool got = child > 0 && read(ends[0], &sample, sizeof sample) == sizeof sample;
  close(ends[0]);
  rusage usage{};
  int status = 0;
  wait4(child, &status, 0, &usage);
  if (!got || status != 0) std::exit(2);
  sample.memory = static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
  return sample;
}

template <typename Value>
double Exponent(const std::vector<Sample>& samples, const Value& value) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const double n = static_cast<double>(samples.size());
  for (const Sample& sample : samples) {
    const double x = std::log(sample.intervals), y = std::log(value(sample));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

int Main(int argc, char** argv) {
  GaitRequest request;
  request.body.model = "human29";
  request.accuracy.level = GaitRequest::AccuracyLevel::kDraft;
  std::string counts = "15,30,60,120,240";
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string flag = argv[i], value = argv[i + 1];
    if (flag == "--model") request.body.model = value;
    if (flag == "--slope") request.slope = std::stod(value) * std::numbers::pi / 180;
    if (flag == "--intervals") counts = value;
    if (flag == "--preset") {
      request.preset = value == "human" ? Preset::kHuman : value == "transport" ? Preset::kTransport : Preset::kTorque;
      request.starts = 1;
    }
  }
  if (!request.preset) {
    request.costs = {{cost::SquaredTorque{}, 1.0}, {cost::SquaredTorqueRate{}, 1e-4}};
  }
  std::printf("%5s %5s %8s %5s %5s %9s | %8s %12s %8s\n", "N", "all", "unknowns", "iter", "total", "objective", "cpu s",
              "ms/iteration", "peak MB");
  std::vector<Sample> samples;
  std::stringstream stream(counts);
  for (std::string count; std::getline(stream, count, ',');) {
    request.discretization.single_support_intervals = std::stoi(count);
    request.discretization.double_support_intervals = std::max(1, std::stoi(count) / 2);
    const Sample sample = SolveApart(request);
    std::printf("%5s %5d %8d %5d %5d %9.4g | %8.2f %12.2f %8.1f%s\n", count.c_str(), sample.intervals, sample.unknowns,
                sample.iterations, sample.all_iterations, sample.objective, sample.cpu,
                1000 * sample.program_cpu / sample.iterations, sample.memory,
                sample.optimal != 0 ? "" : "  not optimal");
    std::fflush(stdout);
    samples.push_back(sample);
  }
  if (samples.size() < 2) return 0;
  std::printf("time ~ N^%.2f, time per iteration ~ N^%.2f\n", Exponent(samples, [](const Sample& s) { return s.cpu; }),
              Exponent(samples, [](const Sample& s) { return s.program_cpu / s.iterations; }));
  return 0;
}

}  // namespace
}  // namespace rollgait

int main(int argc, char** argv) { return rollgait::Main(argc, argv); }
