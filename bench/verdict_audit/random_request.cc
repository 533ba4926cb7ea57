#include "bench/verdict_audit/random_request.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace rollgait::audit {
namespace {

// SplitMix64 (Steele, Lea, Flood 2014).
class Generator {
 public:
  explicit Generator(uint64_t seed) : state_(seed) {}
  uint64_t Next() {
    uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double Share() { return static_cast<double>(Next() >> 11) * 0x1p-53; }  // [0, 1)
  bool Chance(double probability) { return Share() < probability; }
  // Within the range, rounded to a multiple of `step` so that the command can be repeated exactly.
  double Between(double low, double high, double step) {
    return std::round((low + (high - low) * Share()) / step) * step;
  }

 private:
  uint64_t state_;
};

// The request and the flags that make the same one, grown together.
class Draft {
 public:
  explicit Draft(Generator generator) : random(generator) {}
  void Flag(const std::string& text) { command += " " + text; }
  void Number(const char* flag, double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%s %.10g", flag, value);
    Flag(text);
  }
  Generator random;
  GaitRequest request;
  std::string group, command;
};

void DrawModel(const DrawOptions& options, Draft* draft) {
  GaitRequest& request = draft->request;
  const double model = draft->random.Share();
  request.body.model = model < options.planar ? "planar" : "human29";
  draft->group = request.body.model;
  draft->Flag("--model " + request.body.model);
  if (request.body.model == "planar") return;
  request.body.sagittal = model < options.planar + (1 - options.planar) / 3;
  request.body.drop_arms = draft->random.Chance(0.25);
  request.body.rigid_trunk = draft->random.Chance(0.25);
  if (request.body.sagittal) draft->Flag("--sagittal");
  if (request.body.drop_arms) draft->Flag("--drop-arms");
  if (request.body.rigid_trunk) draft->Flag("--rigid-trunk");
  if (request.body.sagittal) draft->group += " sagittal";
  if (request.body.drop_arms || request.body.rigid_trunk) draft->group += " reduced";
}

void DrawBody(Draft* draft) {
  GaitRequest& request = draft->request;
  const bool female = draft->random.Chance(0.5);
  request.body.sex = female ? Sex::kFemale : Sex::kMale;
  request.body.stature = draft->random.Between(1.45, 2.05, 0.01);
  request.body.mass = draft->random.Between(40, 140, 1);
  draft->Flag(female ? "--sex female" : "--sex male");
  draft->Number("--stature", *request.body.stature);
  draft->Number("--mass", *request.body.mass);
  const double feet = draft->random.Share();
  request.body.toes = feet < 0.2;
  if (request.body.toes) {
    draft->Flag("--toes");
  } else if (feet < 0.8) {  // others keep the default of the preset
    request.body.feet = feet < 0.5 ? FootShape::kOneEllipsoid : FootShape::kTwoEllipsoids;
    draft->Flag(feet < 0.5 ? "--feet one" : "--feet two");
  }
}

void DrawPreset(Draft* draft) {
  const double preset = draft->random.Share();
  const std::string name = preset < 0.35 ? "torque" : preset < 0.65 ? "transport" : "human";
  draft->request.preset = preset < 0.35 ? Preset::kTorque : preset < 0.65 ? Preset::kTransport : Preset::kHuman;
  draft->group += ", " + name;
  draft->Flag("--preset " + name);
}

void DrawMotion(const DrawOptions& options, Draft* draft) {
  GaitRequest& request = draft->request;
  const double degrees = draft->random.Between(-options.steepest, options.steepest, 0.5);
  request.slope = degrees * std::numbers::pi / 180.0;
  request.motion.speed = draft->random.Between(0.4, 2.2, 0.05);
  draft->Number("--slope", degrees);
  draft->Number("--speed", *request.motion.speed);
  if (draft->random.Chance(0.25)) {
    request.cycle = Cycle::kFull;
    draft->Flag("--cycle full");
  }
  if (draft->random.Chance(0.3)) {
    request.ground_contact.touch_down = GaitRequest::TouchDown::kPlastic;
    draft->Flag("--touch-down plastic");
  }
}

void DrawNumerics(const DrawOptions& options, Draft* draft) {
  GaitRequest& request = draft->request;
  const double scheme = draft->random.Share();
  request.discretization.scheme = scheme < 0.6   ? Scheme::kRadau2
                                  : scheme < 0.8 ? Scheme::kRadau3
                                                 : Scheme::kHermiteSimpson;
  draft->Flag(scheme < 0.6 ? "--scheme radau2" : scheme < 0.8 ? "--scheme radau3" : "--scheme hermite-simpson");
  using Level = GaitRequest::AccuracyLevel;
  const double level = draft->random.Share();  // drawn also where it is given, so that all else is the same
  request.accuracy.level = options.level.value_or(level < 0.15  ? Level::kDraft
                                                  : level < 0.8 ? Level::kStandard
                                                                : Level::kFine);
  draft->Flag(request.accuracy.level == Level::kDraft      ? "--accuracy draft"
              : request.accuracy.level == Level::kStandard ? "--accuracy standard"
                                                           : "--accuracy fine");
  request.solver_limits.max_wall_time = options.time_limit;
  draft->Number("--time-limit", options.time_limit);
}

void DrawMaxError(Draft* draft) {
  const double kind = draft->random.Share(), level = draft->random.Share();
  const auto between = [&](double most, double least) { return most * std::pow(least / most, level); };
  const auto flag = [&](const char* name, double value) {
    char text[64];
    std::snprintf(text, sizeof text, "--max-error %s=%.10g", name, value);
    draft->Flag(text);
  };
  MaxError& error = draft->request.accuracy.max_error.emplace();
  if (kind < 1. / 3) {
    error.objective = between(1e-2, 1e-4);
    flag("objective", *error.objective);
  } else if (kind < 2. / 3) {
    const double degrees = between(2, 0.1);
    error.angle = degrees * std::numbers::pi / 180.0;
    flag("angle", degrees);
  } else {
    error.torque = between(20, 1);
    flag("torque", *error.torque);
  }
}

}  // namespace

DrawnRequest Draw(const DrawOptions& options, int number) {
  Generator seeds(options.seed);
  const uint64_t stream =
      seeds.Next() + static_cast<uint64_t>(number) * 0xd1342543de82ef95u;  // an odd constant: all differ
  Draft draft{Generator(stream)};
  draft.command = "rollgait solve";
  DrawModel(options, &draft);
  DrawBody(&draft);
  DrawPreset(&draft);
  DrawMotion(options, &draft);
  DrawNumerics(options, &draft);
  if (options.max_error) DrawMaxError(&draft);
  return {draft.request, draft.group, draft.command};
}

}  // namespace rollgait::audit
