#include "core/nlp/ipopt_solver.h"

#include <IpoptConfig.h>

#include <IpIpoptApplication.hpp>
#include <IpIpoptCalculatedQuantities.hpp>
#include <IpIpoptData.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <chrono>

#include "core/nlp/termination.h"

namespace rollgait {
namespace {

using Ipopt::Index;
using Ipopt::Number;
using Clock = std::chrono::steady_clock;

double Seconds(Clock::duration d) { return std::chrono::duration<double>(d).count(); }

class Adapter : public Ipopt::TNLP {
 public:
  Adapter(NlpProblem& problem, const NlpStart& start, const NlpOptions& options, const SolveControl& control,
          NlpResult* result)
      : problem_(problem), start_(start), options_(options), control_(control), result_(result), begin_(Clock::now()) {}

  bool out_of_time() const { return out_of_time_; }
  bool is_rough() const { return is_rough_; }

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jac, Index& nnz_h, IndexStyleEnum& style) override {
    n = problem_.variables();
    m = problem_.constraints();
    nnz_jac = problem_.jacobian_pattern().size();
    nnz_h = problem_.hessian_pattern().size();
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* g_lower, Number* g_upper) override {
    std::copy_n(problem_.lower_bounds().data(), n, lower);
    std::copy_n(problem_.upper_bounds().data(), n, upper);
    std::copy_n(problem_.constraint_lower().data(), m, g_lower);
    std::copy_n(problem_.constraint_upper().data(), m, g_upper);
    return true;
  }

  bool get_starting_point(Index n, bool, Number* x, bool init_z, Number* z_lower, Number* z_upper, Index m,
                          bool init_lambda, Number* lambda) override {
    std::copy_n(start_.x.data(), n, x);
    if (init_z) {
      std::copy_n(start_.lower_bound_multipliers.data(), n, z_lower);
      std::copy_n(start_.upper_bound_multipliers.data(), n, z_upper);
    }
    if (init_lambda) std::copy_n(start_.constraint_multipliers.data(), m, lambda);
    return true;
  }

  bool eval_f(Index, const Number* x, bool, Number& value) override { return problem_.Objective(x, &value); }
  bool eval_grad_f(Index, const Number* x, bool, Number* gradient) override { return problem_.Gradient(x, gradient); }
  bool eval_g(Index, const Number* x, bool, Index, Number* g) override { return problem_.Constraints(x, g); }
  bool eval_jac_g(Index, const Number* x, bool, Index, Index, Index* rows, Index* columns, Number* values) override {
    if (values == nullptr) {
      std::copy(problem_.jacobian_pattern().rows.begin(), problem_.jacobian_pattern().rows.end(), rows);
      std::copy(problem_.jacobian_pattern().columns.begin(), problem_.jacobian_pattern().columns.end(), columns);
      return true;
    }
    point_ = Eigen::Map<const VectorX>(x, problem_.variables());
    return problem_.Jacobian(x, values);
  }
  bool eval_h(Index, const Number* x, bool, Number sigma, Index, const Number* lambda, bool, Index, Index* rows,
              Index* columns, Number* values) override {
    if (values == nullptr) {
      std::copy(problem_.hessian_pattern().rows.begin(), problem_.hessian_pattern().rows.end(), rows);
      std::copy(problem_.hessian_pattern().columns.begin(), problem_.hessian_pattern().columns.end(), columns);
      return true;
    }
    return problem_.Hessian(x, sigma, lambda, values);
  }

  bool intermediate_callback(Ipopt::AlgorithmMode mode, Index iteration, Number objective, Number primal, Number dual,
                             Number mu, Number step_norm, Number regularization, Number dual_step, Number primal_step,
                             Index trials, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities* quantities) override {
    const double elapsed = Seconds(Clock::now() - begin_);
    // The point where its restoration phase ends is given twice with one index, once by that phase.
    if (iteration > last_iteration_ && control_.observer) {
      IterationInfo info;
      info.index = iteration;
      info.objective = objective;
      info.primal_infeasibility = primal;
      info.dual_infeasibility = dual;
      info.barrier_parameter = mu;
      info.step_norm = step_norm;
      info.regularization = regularization;
      info.primal_step = primal_step;
      info.dual_step = dual_step;
      info.line_search_trials = trials;
      info.restoration = mode == Ipopt::RestorationPhaseMode;
      info.elapsed_s = elapsed;
      info.mesh = options_.mesh;
      info.x = point_.data();
      control_.observer(info);
    }
    last_iteration_ = std::max(last_iteration_, iteration);
    if (elapsed > options_.max_wall_time_s) {
      out_of_time_ = true;
      return false;
    }
    if (!has_asked_ && options_.worth_finishing && mode == Ipopt::RegularMode &&
        quantities->curr_nlp_error() <= options_.rough_tolerance) {
      has_asked_ = true;
      is_rough_ = !options_.worth_finishing(point_);
      if (is_rough_) return false;
    }
    return control_.stop == nullptr || !control_.stop->requested();
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* x, const Number* z_lower, const Number* z_upper,
                         Index m, const Number*, const Number* lambda, Number objective, const Ipopt::IpoptData* data,
                         Ipopt::IpoptCalculatedQuantities* quantities) override {
    result_->x = Eigen::Map<const VectorX>(x, n);
    result_->lower_bound_multipliers = Eigen::Map<const VectorX>(z_lower, n);
    result_->upper_bound_multipliers = Eigen::Map<const VectorX>(z_upper, n);
    result_->constraint_multipliers = Eigen::Map<const VectorX>(lambda, m);
    result_->objective = objective;
    // Where Ipopt ends within its restoration phase, its own count lags behind what it has reported.
    result_->iterations = std::max(data->iter_count(), last_iteration_);
    result_->kkt_error = quantities->curr_nlp_error();
    result_->constraint_violation = quantities->curr_nlp_constraint_violation(Ipopt::NORM_MAX);
  }

 private:
  NlpProblem& problem_;
  const NlpStart& start_;
  const NlpOptions& options_;
  const SolveControl& control_;
  NlpResult* result_;
  Clock::time_point begin_;
  bool out_of_time_ = false, has_asked_ = false, is_rough_ = false;
  VectorX point_;  // of the present iteration: derivatives are asked for nowhere else
  Index last_iteration_ = -1;
};

void SetOptions(Ipopt::IpoptApplication& app, const NlpStart& start, const NlpOptions& options) {
  auto& o = *app.Options();
  o.SetIntegerValue("print_level", 0);
  o.SetStringValue("sb", "yes");
  o.SetNumericValue("tol", options.tolerance);
  o.SetNumericValue("constr_viol_tol", options.tolerance);
  o.SetNumericValue("dual_inf_tol", std::max(options.tolerance, 1e-4));
  o.SetNumericValue("compl_inf_tol", std::max(options.tolerance, 1e-6));
  // "Acceptable" is decided here, not by a weaker tolerance that ends a solve early.
  o.SetIntegerValue("acceptable_iter", 0);
  o.SetIntegerValue("max_iter", options.max_iterations);
  o.SetStringValue("linear_solver", "mumps");
  // Approximate minimum degree, set explicitly: the automatic choice may take SCOTCH, whose runs differ from one
  // another.
  o.SetIntegerValue("mumps_pivot_order", 0);
  o.SetIntegerValue("mumps_mem_percent", 200);
  // The transcription scales unknowns, rows and objective itself.
  o.SetStringValue("nlp_scaling_method", "none");
  o.SetStringValue("fixed_variable_treatment", "make_parameter");
  // Moving a solution onto a bound that was relaxed would break the dynamics by that times 1/h².
  o.SetNumericValue("bound_relax_factor", options.BoundRelaxation());
  o.SetStringValue("honor_original_bounds", "no");
  o.SetNumericValue("mu_init", options.initial_barrier);
  o.SetNumericValue("barrier_tol_factor", options.barrier_tolerance);
  if (start.constraint_multipliers.size() > 0) {
    o.SetStringValue("warm_start_init_point", "yes");
    for (const char* name : {"warm_start_bound_push", "warm_start_bound_frac", "warm_start_slack_bound_push",
                             "warm_start_slack_bound_frac", "warm_start_mult_bound_push"}) {
      o.SetNumericValue(name, options.initial_barrier);
    }
  }
}

Termination Interpret(Ipopt::ApplicationReturnStatus status, const Adapter& adapter, const SolveControl& control,
                      const NlpOptions& options, const NlpResult& result) {
  switch (status) {
    case Ipopt::Solve_Succeeded:
      return Termination::kOptimal;
    case Ipopt::User_Requested_Stop:
      if (adapter.is_rough()) return Termination::kOptimal;
      return adapter.out_of_time() ? Termination::kTimeLimit : Termination::kCancelled;
    case Ipopt::Infeasible_Problem_Detected:
      return Termination::kInfeasible;
    case Ipopt::Maximum_Iterations_Exceeded:
      return Termination::kIterationLimit;
    default:
      break;
  }
  if (control.stop != nullptr && control.stop->requested()) return Termination::kCancelled;
  if (result.x.size() > 0 && result.kkt_error <= AcceptableError(options.tolerance)) return Termination::kAcceptable;
  if (status == Ipopt::Restoration_Failed && result.constraint_violation > AcceptableError(options.tolerance)) {
    return Termination::kInfeasible;
  }
  return Termination::kNumericalDifficulty;
}

}  // namespace

NlpResult SolveWithIpopt(NlpProblem& problem, const NlpStart& start, const NlpOptions& options,
                         const SolveControl& control) {
  NlpResult result;
  const auto begin = Clock::now();
  Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
  app->RethrowNonIpoptException(true);
  SetOptions(*app, start, options);
  Ipopt::ApplicationReturnStatus status = app->Initialize("");
  Adapter* adapter = new Adapter(problem, start, options, control, &result);
  const Ipopt::SmartPtr<Ipopt::TNLP> keep = adapter;
  if (status == Ipopt::Solve_Succeeded) status = app->OptimizeTNLP(keep);
  result.termination = Interpret(status, *adapter, control, options, result);
  result.rough = adapter->is_rough();
  result.message = Explain(result.termination);
  result.wall_time_s = Seconds(Clock::now() - begin);
  return result;
}

std::string IpoptVersion() { return std::string("Ipopt ") + IPOPT_VERSION; }

}  // namespace rollgait
