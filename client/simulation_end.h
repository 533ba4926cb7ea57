// How a simulation ended.
#ifndef ROLLGAIT_CLIENT_SIMULATION_END_H_
#define ROLLGAIT_CLIENT_SIMULATION_END_H_

#include <string>

#include "rollgait/v1/simulation.pb.h"

namespace rollgait::client {

// "ended early: too many events; raise max_events" …: what happened, and what to do about it.
std::string SimulationEndText(v1::SimulationReport::End end);

// Whether it went as far as the scene asked for.
bool IsCompleted(v1::SimulationReport::End end);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SIMULATION_END_H_
