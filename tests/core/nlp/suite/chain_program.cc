#include "tests/core/nlp/suite/chain_program.h"

#include <cmath>
#include <random>

namespace rollgait::suite {

// Rows by stages: 3 of the dynamics to x_{k+1}, 1 of the size of u_k.
ChainProgram::ChainProgram(const Kind& kind) : kind_(kind) {
  // The engine's numbers are those of the standard; its distributions are not.
  std::mt19937 engine(kind.seed);
  const auto random = [&engine] { return 2 * (engine() / 4294967296.0) - 1; };
  for (int i = 0; i < kStates; ++i) {
    for (int j = 0; j < kStates; ++j) a_(i, j) = (i == j ? 0.85 : 0) + 0.15 * random();
    for (int j = 0; j < kControls; ++j) b_(i, j) = random();
  }
  const int n = kind.stages * kStage + kStates, m = kind.stages * kRows;
  lower_ = VectorX::Constant(n, -1e20);
  upper_ = -lower_;
  row_lower_ = row_upper_ = VectorX::Zero(m);
  for (int k = 0; k < kind.stages; ++k) {
    lower_.segment<kControls>(k * kStage + kStates).setConstant(-1);
    upper_.segment<kControls>(k * kStage + kStates).setConstant(1);
    row_lower_(k * kRows + kStates) = -1e20;
    row_upper_(k * kRows + kStates) = 1.5;
  }
  for (int i = 0; i < kStates; ++i) {
    lower_(i) = upper_(i) = 2 * random();
    if (kind.has_final) lower_(n - kStates + i) = upper_(n - kStates + i) = kind.final_state;
  }
  MakePatterns();
}

void ChainProgram::MakePatterns() {
  for (int k = 0; k <= kind_.stages; ++k) {
    const int x = k * kStage;
    for (int i = 0; i < (k < kind_.stages ? kStage : kStates); ++i) {
      groups_.variables.push_back(k);
      hessian_.Add(x + i, x + i);
    }
    if (k == kind_.stages) break;
    for (int i = 0; i < kStates; ++i) {
      groups_.constraints.push_back(k);
      for (int j = 0; j < kStage; ++j) jacobian_.Add(k * kRows + i, x + j);
      jacobian_.Add(k * kRows + i, x + kStage + i);
    }
    groups_.constraints.push_back(k);
    for (int j = 0; j < kControls; ++j) jacobian_.Add(k * kRows + kStates, x + kStates + j);
  }
}

bool ChainProgram::Objective(const double* x, double* value) {
  *value = 0;
  for (int k = 0; k <= kind_.stages; ++k) {
    const double* stage = x + k * kStage;
    for (int i = 0; i < kStates; ++i) *value += 0.5 * stage[i] * stage[i] + kind_.cosine * std::cos(stage[i]);
    for (int i = kStates; k < kind_.stages && i < kStage; ++i) *value += 0.5 * control_weight_ * stage[i] * stage[i];
  }
  return std::isfinite(*value);
}

bool ChainProgram::Gradient(const double* x, double* gradient) {
  for (int k = 0; k <= kind_.stages; ++k) {
    for (int i = 0; i < (k < kind_.stages ? kStage : kStates); ++i) {
      const double value = x[k * kStage + i];
      gradient[k * kStage + i] = i < kStates ? value - kind_.cosine * std::sin(value) : control_weight_ * value;
    }
  }
  return true;
}

bool ChainProgram::Constraints(const double* x, double* g) {
  for (int k = 0; k < kind_.stages; ++k) {
    const Eigen::Map<const Eigen::Vector3d> state(x + k * kStage), next(x + (k + 1) * kStage);
    const Eigen::Map<const Eigen::Vector2d> control(x + k * kStage + kStates);
    Eigen::Map<Eigen::Vector3d>(g + k * kRows).noalias() =
        a_ * state + b_ * control + kind_.sine * state.array().sin().matrix() - next;
    g[k * kRows + kStates] = control.squaredNorm();
  }
  return true;
}

bool ChainProgram::Jacobian(const double* x, double* values) {
  for (int k = 0; k < kind_.stages; ++k) {
    const double* stage = x + k * kStage;
    for (int i = 0; i < kStates; ++i) {
      for (int j = 0; j < kStates; ++j) *values++ = a_(i, j) + (i == j ? kind_.sine * std::cos(stage[i]) : 0);
      for (int j = 0; j < kControls; ++j) *values++ = b_(i, j);
      *values++ = -1;
    }
    for (int j = 0; j < kControls; ++j) *values++ = 2 * stage[kStates + j];
  }
  return true;
}

bool ChainProgram::Hessian(const double* x, double sigma, const double* lambda, double* values) {
  for (int k = 0; k <= kind_.stages; ++k) {
    for (int i = 0; i < (k < kind_.stages ? kStage : kStates); ++i) {
      const double value = x[k * kStage + i];
      const double* y = lambda + k * kRows;
      if (i >= kStates) {
        *values++ = sigma * control_weight_ + 2 * y[kStates];
      } else {
        const double curvature = k < kind_.stages ? -y[i] * kind_.sine * std::sin(value) : 0;
        *values++ = sigma * (1 - kind_.cosine * std::cos(value)) + curvature;
      }
    }
  }
  return true;
}

}  // namespace rollgait::suite
