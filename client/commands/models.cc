#include <map>

#include "client/commands/commands.h"
#include "client/import/model_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/joint_kinds.h"
#include "client/json.h"
#include "client/output.h"
#include "client/report/kinematics.h"
#include "client/report/sides.h"
#include "client/report/surface_shape.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Of lengths in m and of directions: less than this is a rounding error.
constexpr double kLeast = 1e-12;

using Rows = std::vector<std::vector<std::string>>;

// The entries of a map of a message by name.
std::map<std::string, double> InOrder(const google::protobuf::Map<std::string, double>& named) {
  return {named.begin(), named.end()};
}

std::string Vector(const Eigen::Vector3d& v) {
  return "(" + FormatVisible(v.x(), kLeast) + ", " + FormatVisible(v.y(), kLeast) + ", " +
         FormatVisible(v.z(), kLeast) + ")";
}

std::string Vector(const v1::Vector3& v) { return Vector(ToVector(v)); }

// "-30 … 120 °", or "free".
std::string PositionRange(const v1::Joint& joint) {
  const bool angle = Turns(joint);
  const double scale = angle ? 180 / kPi : 1.0;
  if (joint.position_max() - joint.position_min() > 1e6) return "free";
  return FormatNumber(joint.position_min() * scale) + " … " + FormatNumber(joint.position_max() * scale) +
         (angle ? "°" : " m");
}

std::string EffortRange(const v1::Joint& joint) {
  if (!joint.actuated()) return "-";
  if (joint.effort_max() > 1e12) return "free";
  return FormatNumber(joint.effort_min()) + " … " + FormatNumber(joint.effort_max()) + (IsSlide(joint) ? " N" : " N m");
}

// Springs and dampers of joints; empty without any.
Rows SpringRows(const v1::Model& model) {
  Rows rows;
  for (const v1::Joint& whole : model.joints()) {
    for (const v1::Joint& joint : TurnsOf(whole)) {
      if (joint.stiffness() == 0 && joint.damping() == 0) continue;
      if (rows.empty()) rows = {{"SPRING AT", "STIFFNESS", "AT REST", "DAMPING"}};
      const bool slides = IsSlide(joint);
      rows.push_back({joint.name(), FormatNumber(joint.stiffness()) + (slides ? " N/m" : " N m/rad"),
                      slides ? FormatNumber(joint.rest_position()) + " m"
                             : FormatVisible(joint.rest_position() * 180 / kPi, 1e-9) + "°",
                      FormatNumber(joint.damping()) + (slides ? " N s/m" : " N m s/rad")});
    }
  }
  return rows;
}

// What the request puts on the body and takes from it, beside its springs; empty without any of it.
Rows ChangeRows(const v1::ModelSelection& selection) {
  Rows rows;
  for (const v1::ModelSelection::Load& load : selection.loads()) {
    rows.push_back({"load on " + load.segment(), FormatNumber(load.mass_kg()) + " kg",
                    load.has_position_m() ? "at " + Vector(load.position_m()) + " m from its upper joint"
                                          : "at the centre of mass of the segment"});
  }
  for (const auto& [joint, share] : InOrder(selection.joint_strengths())) {
    rows.push_back({"strength of " + joint, FormatNumber(100 * share) + " %", share == 0 ? "no muscles" : ""});
  }
  for (const auto& [segment, length] : InOrder(selection.segment_lengths_m())) {
    rows.push_back({"length of " + segment, FormatNumber(length) + " m", ""});
  }
  const std::map<std::string, v1::Vector3> feet(selection.foot_semi_axes_m().begin(),
                                                selection.foot_semi_axes_m().end());
  for (const auto& [surface, axes] : feet) {
    rows.push_back({"semi-axes of " + surface, Vector(axes) + " m", "forward, left, up"});
  }
  for (const auto& [surface, exponent] : InOrder(selection.foot_exponents())) {
    rows.push_back({"exponent of " + surface, FormatNumber(exponent), "1 is the ellipsoid"});
  }
  for (const auto& [joint, angle] : InOrder(selection.locked_joints_rad())) {
    rows.push_back({"locked " + joint, FormatVisible(angle * 180 / kPi, 1e-9) + "°", ""});
  }
  if (!rows.empty()) rows.insert(rows.begin(), {"CHANGE", "HOW MUCH", ""});
  return rows;
}

std::string ModelText(const v1::Model& model) {
  std::string text = model.summary().name() + ": " + model.summary().description() + "\n";
  if (model.summary().has_stored()) {
    const v1::StoredModel& stored = model.summary().stored();
    text += "stored as " + stored.name() + ", " + FormatTime(stored.create_time()) + "\n";
  }
  text += "\n";
  Rows whole = {{"mass", FormatNumber(model.total_mass_kg()), "kg"}};
  if (model.stature_m() > 0) whole.push_back({"stature", FormatNumber(model.stature_m()), "m"});
  const char* const leg = IsOneSided(model) ? "leg length, of the longer leg" : "leg length";
  if (!model.selection().has_rolling_body()) whole.push_back({leg, FormatNumber(model.leg_length_m()), "m"});
  whole.push_back({"gravity", FormatNumber(model.gravity_m_s2()), "m/s²"});
  text += FormatTable(whole, "lr");
  for (const Rows& rows : {ChangeRows(model.selection()), SpringRows(model)}) {
    if (!rows.empty()) text += "\n" + FormatTable(rows, "");
  }
  Rows joints = {{"JOINT", "TYPE", "PARENT", "ORIGIN m", "AXIS", "RANGE", "EFFORT", "LINK", "MASS kg",
                  "CENTRE OF MASS m", "IYY kg m²"}};
  for (const v1::Joint& joint : model.joints()) {
    const bool known_parent = joint.parent() >= 0 && joint.parent() < model.joints_size();
    const bool turns = joint.coordinates_size() > 0;  // each told of in a row of its own
    joints.push_back({joint.name(), JointText(joint), known_parent ? model.joints(joint.parent()).name() : "world",
                      Vector(joint.origin_m()), turns ? "-" : Vector(joint.axis()), turns ? "-" : PositionRange(joint),
                      turns ? "-" : EffortRange(joint), joint.link_name(), FormatNumber(joint.mass_kg()),
                      Vector(joint.center_of_mass_m()),
                      joint.inertia_kg_m2_size() == 6 ? FormatNumber(joint.inertia_kg_m2(1)) : "-"});
    if (!turns) continue;
    for (const v1::Joint& turn : TurnsOf(joint)) {
      joints.push_back({turn.name(), "coordinate", joint.name(), "-", Vector(turn.axis()), PositionRange(turn),
                        EffortRange(turn), "-", "-", "-", "-"});
    }
  }
  text += "\n" + FormatTable(joints, "");
  Rows contacts = {{"CONTACT", "LINK", "SEMI-AXES m", "SHAPE", "CENTRE m", "MIRROR IMAGE"}};
  for (const v1::ContactSurface& contact : model.contacts()) {
    const bool known = contact.joint() >= 0 && contact.joint() < model.joints_size();
    const SurfaceShape shape = ShapeOf(contact.surface());
    contacts.push_back({contact.name(), known ? model.joints(contact.joint()).link_name() : "?",
                        Vector(shape.semi_axes), shape.numbers.empty() ? "-" : shape.numbers,
                        Vector(contact.center_m()), contact.mirror_contact()});
  }
  text += "\n" + FormatTable(contacts, "") + "\nSources\n";
  for (const std::string& source : model.sources()) text += "  " + source + "\n";
  return text;
}

// Those of all pages.
std::vector<v1::ModelSummary> ListModels(Connection& connection) {
  std::vector<v1::ModelSummary> models;
  v1::ListModelsRequest request;
  request.set_page_size(1000);
  do {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::ListModelsResponse response;
    RequireOk(connection.stub().ListModels(&context, request, &response), "list the models", connection.server());
    models.insert(models.end(), response.models().begin(), response.models().end());
    request.set_page_token(response.next_page_token());
  } while (!request.page_token().empty());
  return models;
}

ExitCode ProposeSide(const ModelsOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  const SpecFlags& flags = options.flags;
  if (!flags.model || !IsTreeFile(*flags.model) || !flags.side_file.empty() || !options.format.empty()) {
    throw Failure(ExitCode::kUsage,
                  "--propose-side: needs a " + TreeFileEndings() + " file, and neither --side nor --format");
  }
  const SideProposal proposal = ProposeSideFile(ReadLinkTree(*flags.model));
  if (!global.quiet) {
    terminal.err << "Proposed, to be checked:\n";
    for (const std::string& reason : proposal.reasons) terminal.err << "  " << reason << "\n";
    if (!proposal.missing.empty()) terminal.err << "Missing, to be added:\n";
    for (const std::string& line : proposal.missing) terminal.err << "  " << line << "\n";
  }
  terminal.out << ToJsonText(proposal.side) << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace

ExitCode RunModels(const ModelsOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  const SpecFlags& flags = options.flags;
  if (options.format.empty() && (options.slope_deg || !options.output.empty())) {
    throw Failure(ExitCode::kUsage, "--output and --slope: need --format, one of " + ModelFormatNames());
  }
  if (!options.format.empty()) {
    if (!flags.model) throw Failure(ExitCode::kUsage, "--format: needs the NAME of a model");
    RequireOutput(options.output, FindModelFormat(options.format));
  }
  if (options.propose_side) return ProposeSide(options, global, terminal);
  Connection connection(global);
  if (flags.model) {
    grpc::ClientContext context;
    connection.SetDeadline(context);
    v1::GetModelRequest request;
    request.set_joint_chains(!options.format.empty());  // formats have joints that turn or slide
    const std::string explanation = ApplyBodyFlags(flags, *request.mutable_model());
    if (!global.quiet) terminal.err << explanation << std::flush;
    v1::Model model;
    RequireOk(connection.stub().GetModel(&context, request, &model), "get model " + *flags.model, connection.server());
    if (!options.format.empty()) {
      const Ground ground{.slope_rad = options.slope_deg.value_or(0) * kPi / 180, .gravity_m_s2 = model.gravity_m_s2()};
      WriteExport({{"", FindModelFormat(options.format).of_model(model, ground)}}, options.output, terminal.out);
      return ExitCode::kSuccess;
    }
    terminal.out << (global.json ? ToJsonText(model) : ModelText(model)) << std::flush;
    return ExitCode::kSuccess;
  }
  Rows rows = {{"NAME", "DOF", "ACTUATED", "CONTACTS", "DESCRIPTION"}};
  for (const v1::ModelSummary& model : ListModels(connection)) {
    if (global.json) terminal.out << ToJsonLine(model) << "\n";
    std::string contacts;
    for (const std::string& contact : model.contact_names()) contacts += (contacts.empty() ? "" : ", ") + contact;
    rows.push_back({model.has_stored() ? model.stored().name() : model.name(),
                    std::to_string(model.degrees_of_freedom()), std::to_string(model.actuated_joints()), contacts,
                    model.description()});
  }
  if (!global.json) terminal.out << FormatTable(rows, "lrr");
  terminal.out << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
