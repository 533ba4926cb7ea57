// Estimated errors of a gait line by line, as the accuracy report is told.
#ifndef ROLLGAIT_CLIENT_ERROR_TABLE_H_
#define ROLLGAIT_CLIENT_ERROR_TABLE_H_

#include <vector>

#include "client/accuracy_table.h"

namespace rollgait::client {

// "estimated error of the joint angle", 0.21 °, with the bound that the request sets. Empty without an estimate.
std::vector<AccuracyLine> ErrorLines(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_ERROR_TABLE_H_
