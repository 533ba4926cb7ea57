// A finished solve with a made-up but consistent motion: what the client's tests look at instead of a server's answer.
#ifndef ROLLGAIT_TESTS_CLIENT_SAMPLE_SOLVE_H_
#define ROLLGAIT_TESTS_CLIENT_SAMPLE_SOLVE_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// A planar walker with the tree, names and mirror data of the server's "planar" model and round numbers.
v1::Model SampleModel();

// The half cycle of the sample gait over time t in [0, kSampleSpan_s]: double support for a fifth of it, then single
// support on the left foot. Smooth, mirror-periodic, Radau-2.
constexpr double kSampleSpan_s = 0.55;
constexpr double kSampleDisplacement_m = 0.715;
v1::Trajectory SampleTrajectory(const v1::Model& model);

// The same motion as an iterate with these numbers: its nodes.
v1::Iterate SampleIterate(const v1::Model& model, int index, int mesh);

// Its events: right heel strike at 0 %, left toe off at 10, left heel strike at 50, right toe off at 60.
v1::GaitEvents SampleGaitEvents(const v1::Model& model);

// Position of a joint at time t (any t), the closed form that SampleTrajectory was sampled from.
double SamplePosition(const v1::Model& model, int joint, double time_s);

// The whole: succeeded, optimal, with costs, accuracy, meshes.
v1::Solve SampleSolve(const std::string& name, double slope_rad);

}  // namespace rollgait::client

#endif  // ROLLGAIT_TESTS_CLIENT_SAMPLE_SOLVE_H_
