#include "core/transcription/returned_points.h"

#include "core/base/check.h"

namespace rollgait {

ReturnedPoints ReturnedPointsOf(Scheme scheme) {
  const Tableau tableau = TableauOf(scheme);
  const int s = tableau.points();
  const Scheme returned_as = ReturnedAs(scheme);
  if (returned_as == scheme) return {scheme, tableau.c, MatrixX::Identity(s, s), MatrixX::Identity(s, s)};
  ReturnedPoints returned{returned_as, TableauOf(returned_as).c, MatrixX(3, s), MatrixX(3, s)};
  ROLLGAIT_CHECK(tableau.is_explicit && tableau.starts_at_node() && returned.fractions.size() == 3);
  const Eigen::RowVectorXd first = Eigen::RowVectorXd::Unit(s, 0), velocity = tableau.b.transpose();
  MatrixX& a = returned.acceleration_map;
  a.row(0) = first;
  a.row(1) = 3 * velocity * tableau.A - 0.5 * first;
  a.row(2) = 6 * velocity - a.row(0) - 4 * a.row(1);
  for (int r = 0; r < 3; ++r)
    returned.control_map.row(r) = LagrangeValues(tableau.c, returned.fractions(r)).transpose();
  return returned;
}

}  // namespace rollgait
