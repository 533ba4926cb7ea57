// Time per call of contact kinematics: support jets, a body over a plane, two bodies, the feet of the planar human.
//   contact_kinematics [--benchmark_filter=plane]       ns per call (Google Benchmark; one thread; Release)
//   contact_kinematics --count NAME CALLS               runs one function only, for instructions per call:
//   valgrind --tool=callgrind --toggle-collect='rollgait::Repeat*' contact_kinematics --count plane 1000
//     "Collected" of callgrind divided by the calls.

#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>

#include "core/contact/contact_derivatives.h"
#include "core/contact/pair_derivatives.h"
#include "core/contact/pair_hessians.h"
#include "core/geometry/flattened_superellipsoid.h"
#include "core/models/catalog.h"

namespace rollgait {

Matrix3 Turn(const Vector3& theta) { return Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix(); }

// Everything the functions work on.
struct Case {
  Case() {
    BodyRequest request;
    request.model = "planar";
    scene = std::make_unique<Scene>(BuildScene(request).value());
    tree = std::make_unique<TreeDynamics>(scene->model);
    const VectorX q = VectorX::LinSpaced(scene->model.size(), -0.3, 0.4), v = q.reverse();
    tree->Update(q.data(), v.data(), v.data(), {0, 0, -9.81});
    foot = std::make_unique<ContactDerivatives<double>>(scene->model, scene->contacts[0]);
    moving_foot = std::make_unique<ContactDerivatives<Dual>>(scene->model, scene->contacts[0]);
    body_1 = {Turn({0.3, -0.5, 0.2}), {0.1, 0.2, 0.4}, {1, 2, 3}, {0.3, 0.2, 0.1}, {3, 1, 2}, {0.5, 0.6, 0.7}};
    body_2 = {Turn({-0.4, 0.1, 0.8}), {0.3, 0.5, 1.6}, {2, 1, -1}, {0.1, 0.5, 0.4}, {1, 2, 3}, {0.2, 0.1, 0.9}};
    pair.Compute(body_1, body_2);
  }
  std::unique_ptr<Scene> scene;
  std::unique_ptr<TreeDynamics> tree;
  std::unique_ptr<ContactDerivatives<double>> foot;
  std::unique_ptr<ContactDerivatives<Dual>> moving_foot;
  FrameMotion body_1, body_2;
  PlacedSurface surface_1{Ellipsoid({0.135, 0.05, 0.068}), {0.1, 0, 0}, Turn({0.1, 0.2, 0.3})};
  PlacedSurface surface_2{Ellipsoid({0.3, 0.2, 0.4}), {0, 0.1, 0}, Turn({0.5, 0.2, 0.1})};
  PlacedPlane plane;
  SurfacePair pair{surface_1, surface_2};
  Surface superellipsoid = Superellipsoid(Vector3(0.3, 0.2, 0.4), 0.6, 0.8);
  Surface smooth = SmoothSuperellipsoid(Vector3(0.3, 0.2, 0.4), 0.6, 0.8, 0.1);
  Surface implicit = FlattenedSuperellipsoid::Create({0.3, 0.2, 0.4}, 0.6, 0.8, 0.05).value();
  Vector3 nu{2.0 / 7, 3.0 / 7, 6.0 / 7};
  SupportJet jet;
};

const std::map<std::string, void (*)(Case&)> kFunctions = {
    {"jet_2/ellipsoid", [](Case& c) { c.surface_1.surface.Evaluate(c.nu, 2, &c.jet); }},
    {"jet_3/ellipsoid", [](Case& c) { c.surface_1.surface.Evaluate(c.nu, 3, &c.jet); }},
    {"jet_4/ellipsoid", [](Case& c) { c.surface_1.surface.Evaluate(c.nu, 4, &c.jet); }},
    {"jet_2/superellipsoid", [](Case& c) { c.superellipsoid.Evaluate(c.nu, 2, &c.jet); }},
    {"jet_4/superellipsoid", [](Case& c) { c.superellipsoid.Evaluate(c.nu, 4, &c.jet); }},
    {"jet_2/smooth_superellipsoid", [](Case& c) { c.smooth.Evaluate(c.nu, 2, &c.jet); }},
    {"jet_4/smooth_superellipsoid", [](Case& c) { c.smooth.Evaluate(c.nu, 4, &c.jet); }},
    {"jet_2/implicit", [](Case& c) { c.implicit.Evaluate(c.nu, 2, &c.jet); }},
    {"jet_4/implicit", [](Case& c) { c.implicit.Evaluate(c.nu, 4, &c.jet); }},
    {"plane/kinematics",
     [](Case& c) { benchmark::DoNotOptimize(ComputePlaneContact(c.surface_1, c.body_1, c.plane, c.body_2)); }},
    {"plane/first",
     [](Case& c) { benchmark::DoNotOptimize(ComputePlaneDerivatives(c.surface_1, c.body_1, c.plane, c.body_2, 1)); }},
    {"plane/second",
     [](Case& c) { benchmark::DoNotOptimize(ComputePlaneDerivatives(c.surface_1, c.body_1, c.plane, c.body_2, 2)); }},
    {"plane/second_and_drift",
     [](Case& c) {
       const PairHessians at = PairHessians::OnPlane(c.surface_1, c.body_1, c.plane, c.body_2);
       benchmark::DoNotOptimize(at.Drift(c.nu));
     }},
    {"pair/kinematics_warm", [](Case& c) { benchmark::DoNotOptimize(c.pair.Compute(c.body_1, c.body_2)); }},
    {"pair/kinematics_cold",
     [](Case& c) {
       c.pair.Restart();
       benchmark::DoNotOptimize(c.pair.Compute(c.body_1, c.body_2));
     }},
    {"pair/first",
     [](Case& c) {
       benchmark::DoNotOptimize(
           ComputeSurfacePairDerivatives(c.surface_1, c.body_1, c.surface_2, c.body_2, c.pair.separation(), 1));
     }},
    {"pair/second",
     [](Case& c) {
       benchmark::DoNotOptimize(
           ComputeSurfacePairDerivatives(c.surface_1, c.body_1, c.surface_2, c.body_2, c.pair.separation(), 2));
     }},
    {"pair/second_and_drift",
     [](Case& c) {
       const PairHessians at =
           PairHessians::OfSurfaces(c.surface_1, c.body_1, c.surface_2, c.body_2, c.pair.separation());
       benchmark::DoNotOptimize(at.Drift(c.nu));
     }},
    {"planar_foot/first", [](Case& c) { c.foot->Update(*c.tree); }},
    {"planar_foot/second",
     [](Case& c) {
       c.foot->Update(*c.tree);
       c.foot->UpdateSecond();
     }},
    {"planar_foot/second_along_motion",
     [](Case& c) {
       c.moving_foot->Update(*c.tree);
       c.moving_foot->UpdateSecond();
     }},
};

// A function of its own, so that callgrind can count it alone.
__attribute__((noinline)) void Repeat(void (*function)(Case&), Case& at, int calls) {
  for (int i = 0; i < calls; ++i) function(at);
}

int Count(const char* name, int calls) {
  const auto found = kFunctions.find(name);
  if (found == kFunctions.end() || calls < 1) {
    std::fprintf(stderr, "--count NAME CALLS: no function \"%s\", or no calls\n", name);
    return 2;
  }
  Case at;
  Repeat(found->second, at, calls);
  return 0;
}

}  // namespace rollgait

int main(int argc, char** argv) {
  if (argc == 4 && std::strcmp(argv[1], "--count") == 0) return rollgait::Count(argv[2], std::atoi(argv[3]));
  rollgait::Case at;
  for (const auto& [name, function] : rollgait::kFunctions) {
    benchmark::RegisterBenchmark(name.c_str(), [&at, run = function](benchmark::State& state) {
      for (auto _ : state) {
        run(at);
        benchmark::ClobberMemory();
      }
    });
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  std::puts("Instructions per call: see the head of bench/contact_kinematics.cc.");
  return 0;
}
