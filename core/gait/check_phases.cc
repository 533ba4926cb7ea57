#include <algorithm>

#include "core/gait/request_check.h"

namespace rollgait {
namespace {

constexpr double kDefaultMinDuration = 0.02;  // s, both at 9.81 m/s²
constexpr double kDefaultMaxDuration = 1.5;   // s
constexpr const char* kPath = "phases.phases";

std::string PhasePath(size_t index) { return Indexed(kPath, index); }

// Which feet the standard phases are known for: each of one surface, or each of a heel and a toe.
enum class FeetKind { kOther, kWhole, kHeelAndToe };
FeetKind KindOfFeet(const Scene& scene) {
  const auto has = [&](FootPart part) {
    return scene.FindContact(BodySide::kLeft, part) >= 0 && scene.FindContact(BodySide::kRight, part) >= 0;
  };
  if (has(FootPart::kHeel) && has(FootPart::kToe)) return FeetKind::kHeelAndToe;
  return has(FootPart::kWhole) ? FeetKind::kWhole : FeetKind::kOther;
}

// The standard phases: the left foot has just touched down, the right one is about to leave. Feet of two surfaces come
// down on the heel and leave from the forefoot; the intervals of each support are shared by its two phases. Contract:
// the feet are known.
std::vector<GaitRequest::Phase> StandardPhases(Cycle cycle, const Scene& scene, int single, int both) {
  const auto name = [&](BodySide side, FootPart part) { return scene.contacts[scene.FindContact(side, part)].name; };
  const auto step = [&](BodySide stance, BodySide other) -> std::vector<GaitRequest::Phase> {
    if (KindOfFeet(scene) == FeetKind::kWhole) {
      return {{{name(BodySide::kLeft, FootPart::kWhole), name(BodySide::kRight, FootPart::kWhole)}, {}, {}, {}},
              {{name(stance, FootPart::kWhole)}, {}, {}, {}}};
    }
    const std::string heel = name(stance, FootPart::kHeel), toe = name(stance, FootPart::kToe),
                      leaving = name(other, FootPart::kToe);
    const int half_both = std::max(1, (both + 1) / 2), half_single = std::max(1, (single + 1) / 2);
    return {{{heel, leaving}, half_both, {}, {}},
            {{heel, toe, leaving}, half_both, {}, {}},
            {{heel, toe}, half_single, {}, {}},
            {{toe}, half_single, {}, {}}};
  };
  std::vector<GaitRequest::Phase> phases = step(BodySide::kLeft, BodySide::kRight);
  if (cycle == Cycle::kHalf) return phases;
  for (GaitRequest::Phase& phase : step(BodySide::kRight, BodySide::kLeft)) phases.push_back(std::move(phase));
  return phases;
}

std::vector<int> CheckContacts(const std::string& path, const std::vector<std::string>& names, const Scene& scene,
                               RequestCheck& check) {
  std::vector<int> contacts;
  for (size_t i = 0; i < names.size(); ++i) {
    const std::string field = Indexed(path, i);
    const int index = scene.FindContact(names[i]);
    if (index < 0) {
      std::vector<std::string> known;
      for (const ContactSurface& contact : scene.contacts) known.push_back(contact.name);
      check.Add(field, "no contact " + Quoted(names[i]) + " in model " + Quoted(scene.name) + "; choose from " +
                           ListNames(known));
      return {};
    }
    if (std::find(contacts.begin(), contacts.end(), index) != contacts.end()) {
      check.Add(field, "contact " + Quoted(names[i]) + " is named twice in this phase; name it once");
      return {};
    }
    contacts.push_back(index);
  }
  return contacts;
}

std::vector<int> Sorted(std::vector<int> contacts) {
  std::sort(contacts.begin(), contacts.end());
  return contacts;
}

std::vector<int> Mirrored(std::vector<int> contacts, const Scene& scene) {
  for (int& contact : contacts) contact = scene.contacts[contact].mirror_contact;
  return contacts;
}

// Consecutive phases must differ; a phase whose contacts were refused (empty here) is not compared.
void CheckOrder(const std::vector<GaitSpec::Phase>& phases, Cycle cycle, const Scene& scene, RequestCheck& check) {
  for (size_t i = 0; i < phases.size(); ++i) {
    const bool last = i + 1 == phases.size();
    std::vector<int> next = phases[last ? 0 : i + 1].contacts;
    if (last && cycle == Cycle::kHalf) next = Mirrored(std::move(next), scene);
    if (phases[i].contacts.empty() || Sorted(phases[i].contacts) != Sorted(std::move(next))) continue;
    const std::string follower = !last                   ? "phase " + std::to_string(i + 1)
                                 : cycle == Cycle::kHalf ? "the mirrored phase 0"
                                                         : "phase 0";
    check.Add(PhasePath(i) + ".contacts",
              "the same contacts as " + follower + ", which follows it; join the two or change the contacts of one");
  }
}

GaitSpec::Phase CheckPhase(const std::string& path, const GaitRequest::Phase& phase, int default_intervals,
                           const Scene* scene, const Similarity& similarity, RequestCheck& check) {
  GaitSpec::Phase checked{};
  if (phase.contacts.empty()) {
    check.Add(path + ".contacts", "no contact; name at least one surface that rolls in this phase");
  } else if (scene != nullptr) {
    checked.contacts = CheckContacts(path + ".contacts", phase.contacts, *scene, check);
  }
  checked.intervals = check.Integer(path + ".intervals", phase.intervals, default_intervals, 1, 1000);
  const NumberLimits limits{0, 10, "s", true};
  checked.min_duration =
      check.Number(path + ".min_duration_s", phase.min_duration, similarity.time() * kDefaultMinDuration, limits);
  checked.max_duration =
      check.Number(path + ".max_duration_s", phase.max_duration, similarity.time() * kDefaultMaxDuration, limits);
  if (checked.min_duration > checked.max_duration) {
    check.Add(path + ".min_duration_s", FormatNumber(checked.min_duration) + " s is longer than max_duration_s " +
                                            FormatNumber(checked.max_duration) + " s" +
                                            (phase.max_duration ? "" : " (its default)") + "; give min <= max");
  }
  return checked;
}

}  // namespace

std::vector<GaitSpec::Phase> CheckPhases(const GaitRequest& request, const Scene* scene, const Similarity& similarity,
                                         RequestCheck& check) {
  const GaitRequest::Discretization& mesh = request.discretization;
  const int single =
      check.Integer("discretization.single_support_intervals", mesh.single_support_intervals, 16, 1, 1000);
  const int both = check.Integer("discretization.double_support_intervals", mesh.double_support_intervals,
                                 std::max(1, single / 2), 1, 1000);
  if (request.phases && request.phases->empty()) {
    check.Add(kPath, "no phase; give at least one, or leave `phases` unset for the standard sequence");
    return {};
  }
  if (request.phases && request.phases->size() > static_cast<size_t>(kMaxPhases)) {
    check.Add(kPath, std::to_string(request.phases->size()) + " phases; at most " + std::to_string(kMaxPhases) +
                         " are accepted");
    return {};
  }
  if (!request.phases && scene == nullptr) return {};
  if (!request.phases && KindOfFeet(*scene) == FeetKind::kOther) {
    check.Add("phases", "model " + Quoted(scene->name) + " has no standard phases; give the sequence");
    return {};
  }
  const std::vector<GaitRequest::Phase> phases =
      request.phases ? *request.phases : StandardPhases(*request.cycle, *scene, single, both);
  std::vector<GaitSpec::Phase> checked;
  long total = 0;
  for (size_t i = 0; i < phases.size(); ++i) {
    checked.push_back(
        CheckPhase(PhasePath(i), phases[i], phases[i].contacts.size() > 1 ? both : single, scene, similarity, check));
    total += checked.back().intervals;
  }
  if (total > kMaxTotalIntervals) {
    check.Add(request.phases ? kPath : "discretization", std::to_string(total) +
                                                             " mesh intervals in all phases together; at most " +
                                                             std::to_string(kMaxTotalIntervals) + " are accepted");
  }
  if (scene != nullptr) CheckOrder(checked, *request.cycle, *scene, check);
  return checked;
}

}  // namespace rollgait
