#ifndef ROLLGAIT_CORE_NLP_TIMED_PROBLEM_H_
#define ROLLGAIT_CORE_NLP_TIMED_PROBLEM_H_

#include <chrono>

#include "core/nlp/problem.h"

namespace rollgait {

// A problem that measures how long its functions and derivatives take.
class TimedProblem : public NlpProblem {
 public:
  // `inner` must outlive this object.
  explicit TimedProblem(NlpProblem& inner) : inner_(inner) {}

  double seconds() const { return std::chrono::duration<double>(spent_).count(); }

  int variables() const override { return inner_.variables(); }
  int constraints() const override { return inner_.constraints(); }
  const VectorX& lower_bounds() const override { return inner_.lower_bounds(); }
  const VectorX& upper_bounds() const override { return inner_.upper_bounds(); }
  const VectorX& constraint_lower() const override { return inner_.constraint_lower(); }
  const VectorX& constraint_upper() const override { return inner_.constraint_upper(); }
  const SparsityPattern& jacobian_pattern() const override { return inner_.jacobian_pattern(); }
  const SparsityPattern& hessian_pattern() const override { return inner_.hessian_pattern(); }
  EliminationGroups elimination_groups() const override { return inner_.elimination_groups(); }
  double variable_size(int variable) const override { return inner_.variable_size(variable); }

  bool Objective(const double* x, double* value) override {
    return Timed([&] { return inner_.Objective(x, value); });
  }
  bool Gradient(const double* x, double* gradient) override {
    return Timed([&] { return inner_.Gradient(x, gradient); });
  }
  bool Constraints(const double* x, double* g) override {
    return Timed([&] { return inner_.Constraints(x, g); });
  }
  bool Jacobian(const double* x, double* values) override {
    return Timed([&] { return inner_.Jacobian(x, values); });
  }
  bool Hessian(const double* x, double sigma, const double* lambda, double* values) override {
    return Timed([&] { return inner_.Hessian(x, sigma, lambda, values); });
  }
  bool Derivatives(const double* x, double sigma, const double* lambda, double* jacobian, double* hessian) override {
    return Timed([&] { return inner_.Derivatives(x, sigma, lambda, jacobian, hessian); });
  }

 private:
  using Clock = std::chrono::steady_clock;
  template <typename Call>
  bool Timed(const Call& call) {
    const auto begin = Clock::now();
    const bool finite = call();
    spent_ += Clock::now() - begin;
    return finite;
  }

  NlpProblem& inner_;
  Clock::duration spent_{};
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_TIMED_PROBLEM_H_
