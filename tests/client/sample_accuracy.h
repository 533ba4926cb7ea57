#ifndef ROLLGAIT_TESTS_CLIENT_SAMPLE_ACCURACY_H_
#define ROLLGAIT_TESTS_CLIENT_SAMPLE_ACCURACY_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Of a solve that is within its bounds; five criteria.
v1::AccuracyReport SampleAccuracy();

// Makes the criterion exceed its bound by this factor, and the verdict of the solve EXCEEDED.
void Exceed(v1::Solve& solve, const std::string& criterion, double factor);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_SAMPLE_ACCURACY_H_
