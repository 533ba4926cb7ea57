#include "core/transcription/rate_term.h"

namespace rollgait {
namespace {

double Difference(const Change& change, const double* x) {
  double sum = 0;
  for (const auto& [unknown, coefficient] : change.terms) sum += coefficient * x[unknown];
  return sum;
}

}  // namespace

RateTerm::RateTerm(const DecisionLayout& layout, std::vector<Change> changes)
    : layout_(layout), changes_(std::move(changes)) {
  std::vector<int> unknowns;
  for (const Change& change : changes_) {
    const int duration = layout.duration(change.phase);
    for (size_t a = 0; a < change.terms.size(); ++a) {
      unknowns.push_back(change.terms[a].first);
      for (size_t b = 0; b <= a; ++b) AddPair(change.terms[a].first, change.terms[b].first);
      AddPair(duration, change.terms[a].first);
    }
    AddPair(duration, duration);
  }
  SetUnknowns(std::move(unknowns));
}

double RateTerm::Integral(const double* x) {
  double sum = 0;
  for (const Change& change : changes_) {
    const double difference = Difference(change, x);
    sum += change.weight * difference * difference / (change.ratio * x[layout_.duration(change.phase)]);
  }
  return sum;
}

void RateTerm::AddGradient(const double* x, double factor, double* gradient) {
  for (const Change& change : changes_) {
    const double duration = x[layout_.duration(change.phase)], difference = Difference(change, x);
    const double slope = factor * 2 * change.weight * difference / (change.ratio * duration);
    for (const auto& [unknown, coefficient] : change.terms) gradient[unknown] += slope * coefficient;
    gradient[layout_.duration(change.phase)] -= 0.5 * slope * difference / duration;
  }
}

void RateTerm::Hessian(const double* x, double factor, double* values) {
  for (const Change& change : changes_) {
    const double duration = x[layout_.duration(change.phase)], difference = Difference(change, x);
    const double curvature = factor * 2 * change.weight / (change.ratio * duration);
    for (size_t a = 0; a < change.terms.size(); ++a) {
      const double own = curvature * change.terms[a].second;
      for (size_t b = 0; b <= a; ++b) *values++ = own * change.terms[b].second;
      *values++ = -own * difference / duration;
    }
    *values++ = curvature * difference * difference / (duration * duration);
  }
}

}  // namespace rollgait
