#ifndef ROLLGAIT_SERVER_SIMULATE_SIMULATION_WORKER_H_
#define ROLLGAIT_SERVER_SIMULATE_SIMULATION_WORKER_H_

namespace rollgait::server {

// Serves one wire::SimulatorRequest on a connected stream and ends with done, a refusal or an error: see wire.proto.
// Samples go out in batches of at most 64, or after 50 ms. A parent that has gone ends the run. Returns the exit code
// of the process: 0, or 4 if what came was no request. Never throws.
int ServeOneSimulation(int fd);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SIMULATE_SIMULATION_WORKER_H_
