// The comparison with people as lines of a table.
#ifndef ROLLGAIT_CLIENT_NORMATIVE_TABLE_H_
#define ROLLGAIT_CLIENT_NORMATIVE_TABLE_H_

#include <string>
#include <vector>

#include "rollgait/v1/normative.pb.h"

namespace rollgait::client {

// Rows of cells for one leg: the cycle, joints at an end of their range for half of stance or longer, then the angles
// and moments of each data set. Empty for an unset comparison.
std::vector<std::vector<std::string>> NormativeRows(const v1::NormativeComparison& people);

// "110 / 72 / 108 %", a dash for what is not there.
std::string ForcePeaksText(const v1::ForcePeaks& peaks);

// "deg", "N m/kg" or "% of weight".
std::string QuantityUnit(v1::NormativeCurve::Quantity quantity);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_NORMATIVE_TABLE_H_
