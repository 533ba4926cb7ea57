#include "core/transcription/consecutive_points.h"

#include <algorithm>
#include <map>

#include "core/base/check.h"

namespace rollgait {
namespace {

// Where the effort of actuated joint j comes from in the mirror image, and with which sign.
std::pair<int, double> MirroredEffort(const Model& model, int j) {
  const std::vector<int>& actuated = model.actuated();
  const Joint& joint = model.joint(actuated[j]);
  if (joint.mirror_joint < 0) return {j, 1};
  const auto source = std::find(actuated.begin(), actuated.end(), joint.mirror_joint);
  ROLLGAIT_CHECK(source != actuated.end());
  return {static_cast<int>(source - actuated.begin()), joint.mirror_sign};
}

// The component of a force that counts: (link, direction) along x, (contact, direction) else, told apart by the sign.
std::pair<int, int> Component(const OptimalControlProblem& problem, int contact, int direction) {
  return {direction == 0 ? -1 - problem.contacts[contact].joint : contact, direction};
}

using Changes = std::map<std::pair<int, int>, Change>;

// Adds the forces of one point with a sign; in the mirror image if the point is in the next half cycle.
void AddForces(const OptimalControlProblem& problem, const DecisionLayout& layout, int interval, int point, double sign,
               bool mirrored, Changes* changes) {
  for (const ActiveContact& active : problem.ActiveContacts(layout.phase(interval))) {
    const int contact = mirrored ? problem.contacts[active.contact].mirror_contact : active.contact;
    for (size_t d = 0; d < active.directions.size(); ++d) {
      const int direction = active.directions[d];
      const double mirror = mirrored && direction == 1 ? -1 : 1;
      (*changes)[Component(problem, contact, direction)].terms.emplace_back(
          layout.forces(interval, point) + active.offset + static_cast<int>(d), sign * mirror * problem.force_size());
    }
  }
}

}  // namespace

std::vector<PointLink> ConsecutivePoints(const DecisionLayout& layout, const VectorX& point_fractions) {
  const int last = layout.points() - 1;
  std::vector<PointLink> links;
  const auto add = [&](int from_interval, int from_point, int to_interval, int to_point, double fraction, bool wraps) {
    links.push_back({from_interval, from_point, to_interval, to_point, layout.phase(to_interval),
                     fraction * layout.length(to_interval), wraps});
  };
  for (int k = 0; k < layout.intervals(); ++k) {
    for (int i = 0; i < last; ++i) add(k, i, k, i + 1, point_fractions(i + 1) - point_fractions(i), false);
    if (k + 1 < layout.intervals()) add(k, last, k + 1, 0, point_fractions(0), false);
  }
  add(layout.intervals() - 1, last, 0, 0, point_fractions(0), true);
  return links;
}

std::vector<Change> EffortChanges(const OptimalControlProblem& problem, const DecisionLayout& layout,
                                  const PointLink& link) {
  std::vector<Change> changes;
  const bool mirrored = link.wraps && problem.mirrored;
  for (int j = 0; j < static_cast<int>(problem.model.actuated().size()); ++j) {
    const auto [source, sign] = mirrored ? MirroredEffort(problem.model, j) : std::pair(j, 1.0);
    const double size = problem.effort_size();
    changes.push_back({{{layout.efforts(link.from_interval, link.from_point) + j, -size},
                        {layout.efforts(link.to_interval, link.to_point) + source, sign * size}},
                       1,
                       link.phase,
                       link.ratio});
  }
  return changes;
}

std::vector<std::pair<std::string, Change>> ForceChanges(const OptimalControlProblem& problem,
                                                         const DecisionLayout& layout, const PointLink& link) {
  Changes changes;
  AddForces(problem, layout, link.from_interval, link.from_point, -1, false, &changes);
  AddForces(problem, layout, link.to_interval, link.to_point, 1, link.wraps && problem.mirrored, &changes);
  std::vector<std::pair<std::string, Change>> named;
  for (auto& [component, change] : changes) {
    change.phase = link.phase;
    change.ratio = link.ratio;
    const auto& [owner, direction] = component;
    const std::string name = owner < 0 ? problem.model.joint(-1 - owner).name : problem.contacts[owner].name;
    named.emplace_back(name + " " + std::string(1, "xyz"[direction]), std::move(change));
  }
  return named;
}

std::vector<Change> RateChanges(const RateCost& cost, const OptimalControlProblem& problem,
                                const DecisionLayout& layout, const VectorX& point_fractions) {
  std::vector<Change> all;
  for (const PointLink& link : ConsecutivePoints(layout, point_fractions)) {
    if (link.ratio == 0) continue;
    switch (cost.of) {
      case RateCost::Of::kEfforts: {
        std::vector<Change> changes = EffortChanges(problem, layout, link);
        for (size_t j = 0; j < changes.size(); ++j) {
          changes[j].weight = cost.weights(static_cast<int>(j));
          all.push_back(std::move(changes[j]));
        }
        break;
      }
      case RateCost::Of::kForces:
        for (auto& [name, change] : ForceChanges(problem, layout, link)) all.push_back(std::move(change));
        break;
    }
  }
  return all;
}

}  // namespace rollgait
