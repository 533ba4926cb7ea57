#include "client/formats/opensim_motion.h"

#include <algorithm>

#include "client/formats/body_markers.h"
#include "client/formats/exact_number.h"
#include "client/formats/exported_stride.h"
#include "client/formats/ground_reaction.h"
#include "client/formats/opensim_coordinates.h"
#include "client/formats/osim.h"
#include "client/formats/xml_writer.h"
#include "client/joint_kinds.h"
#include "client/report/kinematics.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Head of a .mot file. `labels` begins with "time".
std::string MotHead(const std::string& title, const std::vector<std::string>& labels, size_t rows, bool degrees,
                    const std::string& about) {
  std::string head = title + "\nversion=1\nnRows=" + std::to_string(rows) +
                     "\nnColumns=" + std::to_string(labels.size()) + "\ninDegrees=" + (degrees ? "yes" : "no") + "\n" +
                     about + " Axes: X forward along the ground, Y its normal, Z right.\nendheader\n";
  for (size_t i = 0; i < labels.size(); ++i) head += (i == 0 ? "" : "\t") + labels[i];
  return head + "\n";
}

// "r" for the right foot: OpenSim's users write ground_force_r_vx.
std::string PlateName(const Plate& plate) {
  return plate.name == "right" ? "r" : plate.name == "left" ? "l" : plate.name;
}

// The feet, and the links of those that have several.
std::vector<Plate> AllPlates(const v1::Solve& solve) {
  std::vector<Plate> plates = FootPlates(solve);
  for (const Plate& plate : LinkPlates(solve)) {
    const bool known =
        std::any_of(plates.begin(), plates.end(), [&plate](const Plate& other) { return other.name == plate.name; });
    if (!known) plates.push_back(plate);
  }
  return plates;
}

void Append(const Eigen::Vector3d& vector, std::string& line) {
  for (const double value : ToOpensim(vector)) line += "\t" + Exact(value);
}

}  // namespace

std::string ToMot(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  const Stride stride = ExportedStride(solve);
  const std::vector<OpensimCoordinate> coordinates = OpensimCoordinates(model);
  std::vector<std::string> labels = {"time"};
  for (const OpensimCoordinate& coordinate : coordinates) labels.push_back(coordinate.name);
  std::string text = MotHead("Coordinates", labels, stride.samples.size(), true, DescribeStride(solve));
  for (const StrideSample& sample : stride.samples) {
    text += Exact(sample.time_s);
    for (int i = 0; i < model.joints_size(); ++i) {
      const double unit = IsSlide(model.joints(i)) ? 1 : 180 / kPi;
      text += "\t" + Exact(coordinates[i].sign * unit * sample.instant.position[i]);
    }
    text += "\n";
  }
  return text;
}

std::string ToGroundReactionMot(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  const Stride stride = ExportedStride(solve);
  std::vector<std::string> labels = {"time"};
  std::vector<std::vector<Reaction>> reactions;
  for (const Plate& plate : AllPlates(solve)) {
    for (const std::string& quantity :
         {"ground_force_" + PlateName(plate) + "_v", "ground_force_" + PlateName(plate) + "_p",
          "ground_torque_" + PlateName(plate) + "_"}) {
      for (const char* const axis : {"x", "y", "z"}) labels.push_back(quantity + axis);
    }
    reactions.push_back(Reactions(stride, model, plate));
  }
  std::string text =
      MotHead("Ground reaction", labels, stride.samples.size(), false,
              DescribeStride(solve) + " Force on the foot in N, centre of pressure in m, moment in N m.");
  for (size_t row = 0; row < stride.samples.size(); ++row) {
    text += Exact(stride.samples[row].time_s);
    for (const std::vector<Reaction>& plate : reactions) {
      Append(plate[row].force, text);
      Append(plate[row].point, text);
      Append(plate[row].couple, text);
    }
    text += "\n";
  }
  return text;
}

std::string ToExternalLoads(const v1::Solve& solve, const std::string& data_file) {
  XmlWriter xml;
  xml.Open("OpenSimDocument", {{"Version", "40000"}});
  xml.Open("ExternalLoads", {{"name", "ground_reaction"}});
  xml.Open("objects");
  for (const Plate& plate : LinkPlates(solve)) {
    const std::string name = PlateName(plate);
    xml.Open("ExternalForce", {{"name", "ground_" + name}});
    xml.Leaf("applied_to_body", solve.result().model().joints(plate.joint).link_name());
    xml.Leaf("force_expressed_in_body", "ground");
    xml.Leaf("point_expressed_in_body", "ground");
    xml.Leaf("force_identifier", "ground_force_" + name + "_v");
    xml.Leaf("point_identifier", "ground_force_" + name + "_p");
    xml.Leaf("torque_identifier", "ground_torque_" + name + "_");
    xml.Close();
  }
  xml.Close();
  xml.Open("groups");
  xml.Close();
  xml.Leaf("datafile", data_file);
  xml.Close();
  xml.Close();
  return xml.Text();
}

std::string ToTrc(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  const Stride stride = ExportedStride(solve);
  const std::vector<BodyMarker> markers = BodyMarkers(model);
  const std::string frames = std::to_string(stride.samples.size());
  const std::string rate = Exact((stride.samples.size() - 1) / stride.duration_s);
  std::string text =
      "PathFileType\t4\t(X/Y/Z)\tmarkers.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n" +
      rate + "\t" + rate + "\t" + frames + "\t" + std::to_string(markers.size()) + "\tmm\t" + rate + "\t1\t" + frames +
      "\nFrame#\tTime";
  std::string axes = "\t";
  for (size_t m = 0; m < markers.size(); ++m) {
    text += "\t" + markers[m].name + (m + 1 < markers.size() ? "\t\t" : "");
    for (const char* const axis : {"X", "Y", "Z"}) axes += std::string("\t") + axis + std::to_string(m + 1);
  }
  text += "\n" + axes + "\n\n";
  for (size_t row = 0; row < stride.samples.size(); ++row) {
    const std::vector<Pose> poses = LinkPoses(model, stride.samples[row].instant.position);
    text += std::to_string(row + 1) + "\t" + Exact(stride.samples[row].time_s);
    for (const BodyMarker& marker : markers) {
      const Pose& link = poses[marker.joint];
      Append(1000 * (link.position + link.rotation * marker.location), text);
    }
    text += "\n";
  }
  return text;
}

std::vector<ExportedFile> ToOpensimFolder(const v1::Solve& solve) {
  const std::string reaction = "ground_reaction.mot";
  return {{"model.osim", ToOsim(solve.result().model(), GroundOf(solve))},
          {"motion.mot", ToMot(solve)},
          {reaction, ToGroundReactionMot(solve)},
          {"external_loads.xml", ToExternalLoads(solve, reaction)},
          {"markers.trc", ToTrc(solve)}};
}

}  // namespace rollgait::client
