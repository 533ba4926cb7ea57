#ifndef ROLLGAIT_TESTS_REFERENCE_CHECK_REPORT_H_
#define ROLLGAIT_TESTS_REFERENCE_CHECK_REPORT_H_

#include <iosfwd>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/reference_check/reader.h"

namespace rollgait::reference {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// What was compared, per family and field, in the order of the first comparison.
class Report {
 public:
  // One comparison: |computed − expected| (in the field's unit) and what is allowed. NaN fails. `where` names the case.
  void Add(const std::string& family, const std::string& field, const std::string& where, Real error, Real tolerance);

  bool empty() const { return rows_.empty(); }
  bool passed() const;
  // Fields whose worst error exceeds the tolerance.
  std::set<std::string> Exceeded() const;
  // One line per family and field: cases, worst error, worst error relative to the tolerance and the case that has it.
  void Print(std::ostream& out) const;

 private:
  struct Row {
    std::string family, field;
    int cases = 0;
    Real worst_error = 0, worst_ratio = 0;
    std::string worst_case;
  };
  std::vector<Row> rows_;
};

// The comparisons of one case: Add with the family and the case's name filled in.
class CaseReport {
 public:
  CaseReport(Report* report, std::string family, std::string where)
      : report_(report), family_(std::move(family)), where_(std::move(where)) {}
  void Number(const std::string& field, Real computed, Real expected, Real tolerance) {
    report_->Add(family_, field, where_, std::abs(computed - expected), tolerance);
  }
  // Euclidean or Frobenius norm of the difference.
  template <typename A, typename B>
  void Norm(const std::string& field, const Eigen::MatrixBase<A>& computed, const Eigen::MatrixBase<B>& expected,
            Real tolerance) {
    report_->Add(family_, field, where_, (computed.template cast<Real>() - expected.template cast<Real>()).norm(),
                 tolerance);
  }

 private:
  Report* report_;
  std::string family_, where_;
};

}  // namespace rollgait::reference

#endif  // ROLLGAIT_TESTS_REFERENCE_CHECK_REPORT_H_
