#include "tests/reference_check/families.h"

namespace rollgait::reference {

const Family kFamilies[] = {
    {"ellipsoid_plane", IsEllipsoidPlane, CheckEllipsoidPlane},
    {"ellipsoid_pair", IsEllipsoidPair, CheckEllipsoidPair},
    {"rolling_derivatives", IsRollingDerivatives, CheckRollingDerivatives},
    {"superellipsoid_plane", IsSuperellipsoidPlane, CheckSuperellipsoidPlane},
    {"ball_analytic", IsBallAnalytic, CheckBallAnalytic},
    {"moving_plane", IsMovingPlane, CheckMovingPlane},
    {"passive_walkers", IsPassiveWalkers, CheckPassiveWalkers},
    {"rattleback", IsRattleback, CheckRattleback},
    {"triaxial", IsTriaxial, CheckTriaxial},
};
const int kFamilyCount = static_cast<int>(sizeof(kFamilies) / sizeof(kFamilies[0]));

bool FirstCaseHas(const Document& document, const std::string& input, const std::string& expected) {
  if (!document.json.is_object()) return false;
  const auto cases = document.json.find("cases");
  if (cases == document.json.end() || !cases->is_array() || cases->empty()) return false;
  const Json& first = (*cases)[0];
  return first.is_object() && first.contains(input) && first.contains("expect") && first["expect"].is_object() &&
         first["expect"].contains(expected);
}

void CheckCases(const Document& document, void (*check)(Fields item, Report* report), Report* report) {
  Fields root(document.json, "file");
  root.Skip("description");
  root.Skip("digits");
  for (Fields& item : root.List("cases")) check(item, report);
  root.Finish();
}

}  // namespace rollgait::reference
