// A finished solve as a file.
#ifndef ROLLGAIT_CLIENT_OUTPUT_H_
#define ROLLGAIT_CLIENT_OUTPUT_H_

#include <string>

#include "rollgait/v1/solve.pb.h"

namespace rollgait::client {

// Refuses a path that WriteSolve could not write, before any work is done. Throws Failure(kUsage) if the ending is not
// .json, .csv or .sto, or if the directory does not exist or is not writable.
void RequireOutputPath(const std::string& path);

// Writes the solve as its path's ending says:
//   .json  the Solve as proto3 JSON
//   .csv   the trajectory at its collocation points, a header line with units, comma separated
//   .sto   the whole gait cycle at 201 equal steps, OpenSim storage, SI units, tab separated
// Throws Failure(kNoSolution) if .csv or .sto is asked for and there is no trajectory, kInternal if writing fails.
void WriteSolve(const v1::Solve& solve, const std::string& path);

// The contents of the files.
std::string ToCsv(const v1::Solve& solve);
std::string ToSto(const v1::Solve& solve);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_OUTPUT_H_
