#include "core/transcription/impulse_distribution.h"

#include <algorithm>
#include <map>
#include <vector>

#include "core/contact/admissible_forces.h"
#include "core/contact/rolling_kinematics.h"

namespace rollgait {
namespace {

bool Transmits(const ContactSurface& surface, int direction) {
  return std::find(surface.directions.begin(), surface.directions.end(), direction) != surface.directions.end();
}

}  // namespace

void TakeLeastImpulses(const OptimalControlProblem& problem, int phase, const VectorX& position, VectorX* impulses) {
  const std::vector<int>& active = problem.phases[phase].active;
  std::map<int, std::vector<int>> links;  // places in `active`
  for (size_t i = 0; i < active.size(); ++i) {
    links[problem.contacts[active[i]].joint].push_back(static_cast<int>(i));
  }
  const BodyDynamics dynamics(problem.model);
  BodyDynamics::State state;
  dynamics.ComputeState(position, VectorX::Zero(problem.model.size()), &state);
  for (const auto& [link, places] : links) {
    if (places.size() < 2) continue;
    std::vector<LinkContact> contacts;
    for (int place : places) {
      const ContactSurface& surface = problem.contacts[active[place]];
      contacts.push_back({ComputeRollingContact(surface, state).p_WP, impulses->segment<3>(3 * place),
                          Transmits(surface, 0), Transmits(surface, 1)});
    }
    // False: at the edge of the cones by rounding. The impulses then have the least ratio, or are as they were.
    AdmissibleForces(problem.friction_coefficient, contacts);
    for (size_t i = 0; i < places.size(); ++i) impulses->segment<3>(3 * places[i]) = contacts[i].force;
  }
}

}  // namespace rollgait
