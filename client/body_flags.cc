// The flags of the model selection.
#include <CLI/CLI.hpp>
#include <algorithm>

#include "client/failure.h"
#include "client/flag_values.h"
#include "client/import/model_file.h"
#include "client/import/tree_file.h"
#include "client/repeated_flags.h"
#include "client/spec_flags.h"
#include "client/spec_words.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

void SetVector(const std::vector<double>& numbers, size_t first, v1::Vector3& vector) {
  vector.set_x(numbers[first]);
  vector.set_y(numbers[first + 1]);
  vector.set_z(numbers[first + 2]);
}

// "NAME=A,B,…": the name, and one to `counts` numbers.
std::pair<std::string, std::vector<double>> ParseNamedNumbers(const std::string& flag, const std::string& text,
                                                              const std::string& form,
                                                              const std::vector<size_t>& counts) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Failure(ExitCode::kUsage, flag + " " + text + ": must be " + form);
  }
  const std::string name = text.substr(0, equals);
  return {name, ParseNumbers(flag + " " + name + "=", text.substr(equals + 1), form, counts)};
}

// Those of the file: what the command line says of a segment replaces them.
void RemoveLoads(const std::string& segment, v1::ModelSelection& selection) {
  auto& loads = *selection.mutable_loads();
  loads.erase(std::remove_if(loads.begin(), loads.end(),
                             [&](const v1::ModelSelection::Load& load) { return load.segment() == segment; }),
              loads.end());
}

// "heel_l=0.035,0.03,0.02:0.8"; either part may be left out.
void ApplyFoot(const std::string& text, v1::ModelSelection& selection) {
  const std::string form = "SURFACE=A,B,C[:EXPONENT] or SURFACE=:EXPONENT, A,B,C in m";
  const size_t colon = text.find(':');
  const std::string axes = text.substr(0, colon);
  std::string surface = axes.substr(0, axes.find('='));
  if (colon == std::string::npos || !axes.ends_with('=')) {
    const auto [name, numbers] = ParseNamedNumbers("--foot", axes, form, {3});
    SetVector(numbers, 0, (*selection.mutable_foot_semi_axes_m())[name]);
  } else if (surface.empty()) {
    throw Failure(ExitCode::kUsage, "--foot " + text + ": must be " + form);
  }
  if (colon == std::string::npos) return;
  const std::vector<double> exponent = ParseNumbers("--foot " + axes + ":", text.substr(colon + 1), form, {1});
  (*selection.mutable_foot_exponents())[surface] = exponent[0];
}

void ApplyChanges(const SpecFlags& flags, v1::ModelSelection& selection) {
  for (const std::string& text : flags.loads) {
    const auto [segment, numbers] = ParseNamedNumbers("--load", text, "SEGMENT=KG or SEGMENT=KG,X,Y,Z", {1, 4});
    RemoveLoads(segment, selection);
    v1::ModelSelection::Load& load = *selection.add_loads();
    load.set_segment(segment);
    load.set_mass_kg(numbers[0]);
    if (numbers.size() == 4) SetVector(numbers, 1, *load.mutable_position_m());
  }
  for (const std::string& text : flags.strengths) {
    const auto [joint, share] = ParseAssignment("--strength", text);
    (*selection.mutable_joint_strengths())[joint] = share;
  }
  for (const std::string& text : flags.springs) {
    const auto [joint, numbers] = ParseNamedNumbers("--spring", text, "JOINT=STIFFNESS[,REST[,DAMPING]]", {1, 2, 3});
    v1::ModelSelection::JointSpring& spring = (*selection.mutable_joint_springs())[joint];
    spring.Clear();
    spring.set_stiffness_n_m_rad(numbers[0]);
    if (numbers.size() > 1) spring.set_rest_rad(numbers[1] * kPi / 180.0);
    if (numbers.size() > 2) spring.set_damping_n_m_s_rad(numbers[2]);
  }
  for (const std::string& text : flags.foot_axes) {
    ApplyFoot(text, selection);
  }
}

}  // namespace

bool HasBodyFlags(const SpecFlags& flags) {
  return flags.model || !flags.side_file.empty() || flags.sex || flags.stature_m || flags.mass_kg || flags.feet ||
         flags.ranges || flags.toes || flags.sagittal || flags.drop_arms || flags.rigid_trunk || flags.semi_axes ||
         !flags.locks.empty() || !flags.segments.empty() || !flags.loads.empty() || !flags.strengths.empty() ||
         !flags.springs.empty() || !flags.foot_axes.empty();
}

void AddBodyFlags(CLI::App& command, SpecFlags& flags) {
  command
      .add_option("--side", flags.side_file,
                  "Of a model in a URDF, MJCF or .osim file: rollgait.v1.ModelSideFile as JSON, with feet, roles, "
                  "reference posture")
      ->group("Body");
  command.add_option("--sex", flags.sex, "Segment table: female or male (default male)")->group("Body");
  command.add_option("--stature", flags.stature_m, "Body height in m, [1.0, 2.3]")->group("Body");
  command.add_option("--mass", flags.mass_kg, "Body mass in kg, [20, 250]; of the ball [0.001, 1e6]")->group("Body");
  command.add_option("--semi-axes", flags.semi_axes, "Of the ball: A,B,C in m, for example 0.15,0.1,0.1")
      ->group("Body");
  AddRepeatedFlag(command, "--segment", flags.segments,
                  "SEGMENT=LENGTH in m, for example thigh=0.45, of one side thigh_l=0.42", "segment")
      ->group("Body");
  command.add_option("--feet", flags.feet, "Surfaces of each foot: one or two (heel and forefoot)")->group("Body");
  AddRepeatedFlag(command, "--foot", flags.foot_axes,
                  "SURFACE=A,B,C[:EXPONENT] or SURFACE=:EXPONENT: semi-axes of a surface of the feet in m, forward, "
                  "left, up, and its exponent, [0.4, 1.8], 1 an ellipsoid, less boxier; foot, or heel and forefoot, of "
                  "one side heel_l",
                  "surface")
      ->group("Body");
  command.add_option("--ranges", flags.ranges, "Ranges of the joints: anatomical or walking")->group("Body");
  command.add_flag("--toes", flags.toes, "Toe joints; feet of two ellipsoids")->group("Body");
  command.add_flag("--sagittal", flags.sagittal, "Fix everything that moves sideways")->group("Body");
  command.add_flag("--drop-arms", flags.drop_arms, "Fix shoulders and elbows, arms hanging")->group("Body");
  command.add_flag("--rigid-trunk", flags.rigid_trunk, "Fix the trunk joints")->group("Body");
  AddRepeatedFlag(command, "--lock", flags.locks, "JOINT=DEGREES: fix a joint, for example knee_l=20", "joint")
      ->group("Body");
  AddRepeatedFlag(command, "--load", flags.loads,
                  "SEGMENT=KG or SEGMENT=KG,X,Y,Z: a mass that hangs on a segment, for example hand_l=10; X forward, Y "
                  "up, Z right from its upper joint in m",
                  "segment")
      ->group("Body");
  AddRepeatedFlag(command, "--strength", flags.strengths,
                  "JOINT=SHARE: weaken a joint, for example knee_l=0.3; 0 leaves no muscles", "joint")
      ->group("Body");
  AddRepeatedFlag(command, "--spring", flags.springs,
                  "JOINT=STIFFNESS[,REST[,DAMPING]] in N m/rad, degrees, N m s/rad: a spring beside the muscles",
                  "joint")
      ->group("Body");
}

std::string ApplyBodyFlags(const SpecFlags& flags, v1::ModelSelection& selection) {
  std::string explanation;
  if (!flags.side_file.empty() && !(flags.model && IsModelFile(*flags.model))) {
    throw Failure(ExitCode::kUsage, "--side: needs a model in a " + TreeFileEndings() + " file");
  }
  // One or the other, whatever a file of the whole request says.
  if (flags.model && IsModelFile(*flags.model)) {
    selection.Clear();
    ModelFile file = ReadModelFile(*flags.model, flags.side_file);
    *selection.mutable_own() = std::move(file.model);
    explanation = std::move(file.explanation);
  } else if (flags.model) {
    selection.clear_own();
    selection.set_name(*flags.model);
  }
  if (flags.sex) {
    selection.set_sex(Lookup("--sex", *flags.sex, SexWords()));
  }
  if (flags.stature_m) selection.set_stature_m(*flags.stature_m);
  if (flags.mass_kg && selection.name() == "ball") selection.mutable_rolling_body()->set_mass_kg(*flags.mass_kg);
  if (flags.mass_kg && selection.name() != "ball") selection.set_body_mass_kg(*flags.mass_kg);
  if (flags.semi_axes) {
    SetVector(ParseNumbers("--semi-axes", *flags.semi_axes, "A,B,C in m", {3}), 0,
              *selection.mutable_rolling_body()->mutable_semi_axes_m());
  }
  for (const std::string& text : flags.segments) {
    const auto [segment, length] = ParseAssignment("--segment", text);
    (*selection.mutable_segment_lengths_m())[segment] = length;
  }
  if (flags.feet) {
    selection.set_feet(Lookup("--feet", *flags.feet, FeetWords()));
  }
  if (flags.ranges) {
    selection.set_ranges(Lookup("--ranges", *flags.ranges, RangesWords()));
  }
  if (flags.toes) selection.set_toes(true);
  if (flags.sagittal) selection.set_sagittal(true);
  if (flags.drop_arms) selection.set_drop_arms(true);
  if (flags.rigid_trunk) selection.set_rigid_trunk(true);
  for (const std::string& text : flags.locks) {
    const auto [joint, degrees] = ParseAssignment("--lock", text);
    (*selection.mutable_locked_joints_rad())[joint] = degrees * kPi / 180.0;
  }
  ApplyChanges(flags, selection);
  return explanation;
}

}  // namespace rollgait::client
