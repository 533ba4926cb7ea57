// Time per call of the dynamics of the planar human (9 degrees of freedom) and of the human in space (29), one thread.
//   dynamics [--benchmark_filter=/29]                         ns per call (Google Benchmark; Release)
//   dynamics --count NAME MODEL CALLS                         runs one function only, for instructions per call:
//   valgrind --tool=callgrind --toggle-collect='rollgait::Repeat*' dynamics --count inverse_dynamics human29 1000
//     "Collected" of callgrind divided by the calls.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/contact/contact_sensitivity.h"
#include "core/models/catalog.h"
#include "core/multibody/tree_dynamics.h"

namespace rollgait {

// Everything the functions work on, at one random state.
struct Case {
  explicit Case(const std::string& name) {
    BodyRequest request;
    request.model = name;
    scene = std::make_unique<Scene>(BuildScene(request).value());
    n = scene->model.size();
    tree = std::make_unique<TreeDynamics>(scene->model);
    std::vector<TreeContact> contacts;
    for (const ContactSurface& surface : scene->contacts) {
      TreeContact& foot = contacts.emplace_back();
      foot.link = surface.joint;
      foot.surface.surface = surface.surface;
      foot.surface.p_BE = surface.p_LE;
      foot.surface.R_BE = surface.R_LE;
      if (surface.directions.size() == 2) foot.grip = Grip::kRollingAlong;
    }
    contact = std::make_unique<ContactDynamics>(BodyDynamics(scene->model), contacts);
    sensitivity = std::make_unique<ContactSensitivitySolver>(scene->model, contact.get());
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-0.5, 0.5);
    const auto vector = [&] {
      VectorX x(n);
      for (double& value : x) value = uniform(random);
      return x;
    };
    q = vector();
    v = vector();
    a = vector();
    lambda = vector();
    tau = VectorX::Zero(n);
    dq = dv = da = qq = qv = qa = vv = MatrixX::Zero(n, n);
    rows = std::make_unique<RowHessians>(n);
    tree->Update(q.data(), v.data(), a.data(), gravity);
  }

  std::unique_ptr<Scene> scene;
  int n = 0;
  std::unique_ptr<TreeDynamics> tree;
  std::unique_ptr<RowHessians> rows;
  std::unique_ptr<ContactDynamics> contact;
  std::unique_ptr<ContactSensitivitySolver> sensitivity;
  const std::vector<FrameMotion> ground{1};
  const std::vector<int> one{0}, two{0, 1};
  VectorX q, v, a, lambda, tau, drift;
  MatrixX jacobian, dq, dv, da, qq, qv, qa, vv;
  Vector3 gravity{0, 0, -9.81};
};

void InverseDynamics(Case& c) {
  c.tree->Update(c.q.data(), c.v.data(), c.a.data(), c.gravity);
  c.tree->InverseDynamics(c.tau.data());
}

void FirstDerivatives(Case& c) {
  c.tree->Update(c.q.data(), c.v.data(), c.a.data(), c.gravity);
  c.tree->FirstDerivatives(c.dq, c.dv, c.da);
}

// The Hessian of one combination of the rows, together with everything before it.
void ContractedSecond(Case& c) {
  c.tree->Update(c.q.data(), c.v.data(), c.a.data(), c.gravity);
  c.tree->AddContractedHessian(c.lambda.data(), c.qq, c.qv, c.qa, c.vv);
}

// The Hessian of every row.
void AllSecond(Case& c) {
  c.tree->Update(c.q.data(), c.v.data(), c.a.data(), c.gravity);
  c.tree->SecondDerivatives(c.rows.get());
}

void MassMatrix(Case& c) { c.tree->MassMatrix(c.q.data(), c.da); }

// Without contact, by factorising the mass matrix.
void ForwardDynamics(Case& c) {
  c.tree->ForwardDynamics(c.q.data(), c.v.data(), c.lambda.data(), c.gravity, c.tau.data());
}

void Roll(Case& c, const std::vector<int>& active) {
  c.contact->SetState(c.q, c.v, c.ground);
  c.contact->Accelerate(active, c.lambda, c.gravity, {});
}
// Jacobian and drift of the rows of rolling, with the kinematics of the tree.
void Rows(Case& c, const std::vector<int>& active) {
  c.contact->SetState(c.q, c.v, c.ground);
  c.contact->AccelerationRows(active, {}, &c.jacobian, &c.drift);
}
void OneContactRows(Case& c) { Rows(c, c.one); }
void TwoContactsRows(Case& c) { Rows(c, c.two); }

void OneContact(Case& c) { Roll(c, c.one); }
void TwoContacts(Case& c) { Roll(c, c.two); }

// With the derivatives of accelerations and forces by q, v and τ.
void Differentiate(Case& c, const std::vector<int>& active) {
  c.contact->SetState(c.q, c.v, c.ground);
  c.sensitivity->Solve(active, c.lambda, c.gravity, {});
}
void OneContactDerivatives(Case& c) { Differentiate(c, c.one); }
void TwoContactsDerivatives(Case& c) { Differentiate(c, c.two); }

void Kinematics(Case& c) { c.tree->UpdateKinematics(c.q.data(), c.v.data()); }

const std::map<std::string, void (*)(Case&)> kFunctions = {
    {"kinematics", Kinematics},
    {"inverse_dynamics", InverseDynamics},
    {"mass_matrix", MassMatrix},
    {"forward_dynamics", ForwardDynamics},
    {"one_contact_rows", OneContactRows},
    {"two_contacts_rows", TwoContactsRows},
    {"one_contact", OneContact},
    {"one_contact_derivatives", OneContactDerivatives},
    {"two_contacts", TwoContacts},
    {"two_contacts_derivatives", TwoContactsDerivatives},
    {"first_derivatives", FirstDerivatives},
    {"contracted_second", ContractedSecond},
    {"all_second", AllSecond},
};

// A function of its own, so that callgrind can count it alone.
__attribute__((noinline)) void Repeat(void (*function)(Case&), Case& at, int calls) {
  for (int i = 0; i < calls; ++i) function(at);
}

int Count(const char* name, const char* model, int calls) {
  const auto found = kFunctions.find(name);
  if (found == kFunctions.end() || calls < 1) {
    std::fprintf(stderr, "--count NAME MODEL CALLS: no function \"%s\", or no calls\n", name);
    return 2;
  }
  Case at(model);
  Repeat(found->second, at, calls);
  return 0;
}

void RegisterAll() {
  for (const auto& [name, function] : kFunctions) {
    for (const auto& [model, degrees] : {std::pair("planar", "9"), std::pair("human29", "29")}) {
      auto at = std::make_shared<Case>(model);
      benchmark::RegisterBenchmark((name + "/" + degrees).c_str(), [at, run = function](benchmark::State& state) {
        for (auto _ : state) {
          run(*at);
          benchmark::ClobberMemory();
        }
      });
    }
  }
}

}  // namespace rollgait

int main(int argc, char** argv) {
  if (argc == 5 && std::strcmp(argv[1], "--count") == 0) return rollgait::Count(argv[2], argv[3], std::atoi(argv[4]));
  rollgait::RegisterAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
