#include "core/gait/meshes.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rollgait {
namespace {

constexpr double kRounding = 1e-9;  // of lengths of intervals that were read from times

bool IsSamePhase(const std::vector<double>& phase, const std::vector<double>& other) {
  return std::equal(phase.begin(), phase.end(), other.begin(), other.end(),
                    [](double a, double b) { return std::abs(a - b) <= kRounding * a; });
}

}  // namespace

int TotalIntervals(const Mesh& mesh) {
  size_t total = 0;
  for (const std::vector<double>& phase : mesh.fractions) total += phase.size();
  return static_cast<int>(total);
}

Mesh RequestedMesh(const GaitSpec& spec) {
  std::vector<int> intervals;
  for (const GaitSpec::Phase& phase : spec.phases) intervals.push_back(phase.intervals);
  return Mesh::Uniform(intervals);
}

Mesh MeshOf(const Trajectory& trajectory) {
  Mesh mesh;
  for (const TrajectoryPhase& phase : trajectory.phases) {
    std::vector<double>& fractions = mesh.fractions.emplace_back();
    const double length = phase.node_times.back() - phase.node_times.front();
    for (size_t k = 1; k < phase.node_times.size(); ++k) {
      fractions.push_back((phase.node_times[k] - phase.node_times[k - 1]) / length);
    }
  }
  return mesh;
}

bool IsSameMesh(const Mesh& mesh, const Mesh& other) {
  return std::equal(mesh.fractions.begin(), mesh.fractions.end(), other.fractions.begin(), other.fractions.end(),
                    IsSamePhase);
}

bool HasShorterIntervals(const Mesh& mesh, const Mesh& other) {
  const auto shortest = [](const std::vector<double>& phase) { return *std::min_element(phase.begin(), phase.end()); };
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    if (shortest(mesh.fractions[p]) < (1 - kRounding) * shortest(other.fractions[p])) return true;
  }
  return false;
}

bool IsAtLeastAsFine(const Mesh& mesh, const Mesh& other) {
  for (size_t p = 0; p < mesh.fractions.size(); ++p) {
    if (mesh.fractions[p].size() < other.fractions[p].size()) return false;
  }
  return true;
}

}  // namespace rollgait
