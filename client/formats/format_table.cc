#include "client/formats/format_table.h"

#include <filesystem>

#include "client/failure.h"
#include "client/formats/bvh.h"
#include "client/formats/gltf.h"
#include "client/formats/mcap.h"
#include "client/formats/mjcf.h"
#include "client/formats/opensim_motion.h"
#include "client/formats/osim.h"
#include "client/formats/points_csv.h"
#include "client/formats/sto.h"
#include "client/formats/stride_csv.h"
#include "client/formats/urdf.h"
#include "client/formats/urdf_side.h"
#include "client/json.h"
#include "client/text.h"
#include "core/base/nearest_word.h"

namespace rollgait::client {
namespace {

std::string Urdf(const v1::Model& model, const Ground&) { return ToUrdf(model); }
std::string UrdfSide(const v1::Model& model, const Ground&) { return ToUrdfSide(model); }
std::string Json(const v1::Solve& solve) { return ToJsonText(solve); }

template <typename Chosen>
std::string Join(const Chosen& chosen, std::string Format::*word) {
  std::string text;
  for (const Format& format : Formats()) {
    const std::string& value = format.*word;
    if (!chosen(format) || value.empty() || (", " + text + ",").find(", " + value + ",") != std::string::npos) continue;
    text += (text.empty() ? "" : ", ") + value;
  }
  return text;
}

const auto kAny = [](const Format&) { return true; };

}  // namespace

const std::vector<Format>& Formats() {
  static const std::vector<Format> table = {
      {.name = "json", .ending = ".json", .what = "the whole Solve as proto3 JSON", .of_solve = Json},
      {.name = "csv", .ending = ".csv", .what = "the motion at the times of its collocation points", .of_solve = ToCsv},
      {.name = "sto",
       .ending = ".sto",
       .what = "the gait cycle as OpenSim storage, the service's axes",
       .of_solve = ToSto},
      {.name = "stride",
       .ending = ".csv",
       .what = "both legs over the whole stride, forces and pressure",
       .of_solve = ToStrideCsv},
      {.name = "mjcf", .ending = ".xml", .what = "the model for MuJoCo", .of_model = ToMjcf},
      {.name = "urdf", .ending = ".urdf", .what = "the model as URDF", .of_model = Urdf},
      {.name = "urdf-side", .ending = ".json", .what = "what the URDF does not say, for --side", .of_model = UrdfSide},
      {.name = "opensim",
       .ending = "",
       .what = "model, motion, ground reaction, loads, markers",
       .folder_of_solve = ToOpensimFolder},
      {.name = "osim", .ending = ".osim", .what = "the model for OpenSim 4", .of_model = ToOsim},
      {.name = "mot", .ending = ".mot", .what = "its motion", .of_solve = ToMot},
      {.name = "grf",
       .ending = ".mot",
       .what = "its ground reaction: force, pressure, free moment",
       .of_solve = ToGroundReactionMot},
      {.name = "trc", .ending = ".trc", .what = "its markers", .of_solve = ToTrc},
      {.name = "bvh", .ending = ".bvh", .what = "the walking body for animation programs", .of_solve = ToBvh},
      {.name = "gltf", .ending = ".gltf", .what = "the walking body as an animated glTF 2.0 scene", .of_solve = ToGltf},
      {.name = "glb", .ending = ".glb", .what = "the same as one binary file", .of_solve = ToGlb},
      {.name = "mcap", .ending = ".mcap", .what = "motion, forces and body for Foxglove", .of_solve = ToMcap},
  };
  return table;
}

const Format& FindFormat(const std::string& name) {
  for (const Format& format : Formats()) {
    if (format.name == name) return format;
  }
  std::vector<std::string> names;
  for (const Format& format : Formats()) names.push_back(format.name);
  throw Failure(ExitCode::kUsage,
                "--format " + name + ": must be one of " + SolveFormatNames() + DidYouMean(name, names));
}

const Format& FindModelFormat(const std::string& name) {
  const Format& format = FindFormat(name);
  if (!format.of_model) {
    const bool json = name == "json";
    throw Failure(ExitCode::kUsage, "--format " + name + ": " +
                                        (json ? "is the flag --json for a model; other formats are "
                                              : "needs a solve; a model alone is one of ") +
                                        ModelFormatNames());
  }
  return format;
}

const Format& FormatOfPath(const std::string& path, std::string_view flag) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const Format& format : Formats()) {
    if (!ending.empty() && format.ending == ending) return format;
  }
  throw Failure(ExitCode::kUsage,
                std::string(flag) + " " + path + ": the name must end in one of " + Join(kAny, &Format::ending));
}

std::string ModelFormatNames() {
  return Join([](const Format& format) { return format.of_model != nullptr; }, &Format::name);
}

std::string SolveFormatNames() { return Join(kAny, &Format::name); }

std::vector<ExportedFile> ExportSolve(const v1::Solve& solve, const Format& format) {
  const bool has_trajectory = solve.has_result() && solve.result().trajectory().phases_size() > 0;
  if (!has_trajectory && format.name != "json") {
    throw Failure(ExitCode::kNoSolution, solve.name() + " has no trajectory to write (state " +
                                             StateName(solve.state()) + "); use a .json file to keep what it says");
  }
  if (format.folder_of_solve) return format.folder_of_solve(solve);
  if (format.of_model) return {{"", format.of_model(solve.result().model(), GroundOf(solve))}};
  return {{"", format.of_solve(solve)}};
}

}  // namespace rollgait::client
