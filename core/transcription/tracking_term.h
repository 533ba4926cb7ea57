#ifndef ROLLGAIT_CORE_TRANSCRIPTION_TRACKING_TERM_H_
#define ROLLGAIT_CORE_TRANSCRIPTION_TRACKING_TERM_H_

#include <vector>

#include "core/transcription/coupling_term.h"

namespace rollgait {

// ∫ Σ w_j (q_j(t) − r_j(θ))² dt by the quadrature of the scheme. Point i of interval k in phase p, at the constant
// fraction s of it, is at  θ = (Σ_{r<p} T_r + s T_p) / S,  S = Σ T_r, with
//   ∂θ/∂T_r = (n_r − θ)/S,  ∂²θ/∂T_r∂T_u = −(θ_r + θ_u)/S,   n_r = 1, s, 0 for r < p, r = p, r > p.
class TrackingTerm : public CouplingTerm {
 public:
  TrackingTerm(const TrackingCost& cost, const DecisionLayout& layout, const EliminatedScheme& scheme);

  double Integral(const double* x) override;
  void AddGradient(const double* x, double factor, double* gradient) override;
  void Hessian(const double* x, double factor, double* values) override;

 private:
  // Error e = q − r of a channel at the point that was set, with q's derivatives by h and r's by θ.
  struct Residual {
    double e, q_h, q_hh, r_t, r_tt;
  };

  void SetTimes(const double* x);
  void SetStep(double h);
  // The point under evaluation: weight of the quadrature without h, θ and its derivatives.
  void SetPoint(const double* x, int interval, int point);
  Residual Evaluate(const double* x, const TrackingCost::Channel& channel);
  // slope_: derivatives of e by the sources and then the durations.
  void SetSlope(const Residual& residual);
  void AddLocalHessian(const Residual& residual, double factor);

  const TrackingCost& cost_;
  const DecisionLayout& layout_;
  const EliminatedScheme& scheme_;
  int sources_, durations_;

  std::vector<double> phase_start_;  // s, one a phase and the end
  double step_ = -1;
  MatrixX value_, first_, second_;  // of positions: points × sources, times the unit of the unknown
  int interval_ = 0, point_ = 0, phase_ = 0;
  double quadrature_ = 0, length_ = 0, h_ = 0, theta_ = 0;
  VectorX theta_rate_;  // ∂θ/∂T
  VectorX slope_;
  MatrixX local_, duration_hessian_;  // lower triangles
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_TRANSCRIPTION_TRACKING_TERM_H_
