#include <grpcpp/client_context.h>

#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "client/commands/scene_input.h"
#include "client/commands/simulation_commands.h"
#include "client/commands/simulation_document.h"
#include "client/failure.h"
#include "client/interrupt.h"
#include "client/json.h"
#include "client/output.h"
#include "client/simulation_end.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// Where the samples go: JSON, a line a message, or a table of comma separated values.
class SampleWriter {
 public:
  SampleWriter(const v1::SimulationScene& scene, bool json, std::ostream& out) : json_(json), out_(out) {
    if (json) return;
    out << "time_s";
    for (const v1::SceneJoint& joint : scene.joints()) {
      const bool free = joint.type() == v1::Joint::TYPE_FREE;
      for (const char* suffix : {".qw", ".qx", ".qy", ".qz", ".x", ".y", ".z"}) {
        if (free) out << "," << joint.name() << suffix;
      }
      if (!free) out << "," << joint.name();
    }
    for (const v1::SceneJoint& joint : scene.joints()) {
      const bool free = joint.type() == v1::Joint::TYPE_FREE;
      for (const char* suffix : {".wx", ".wy", ".wz", ".vx", ".vy", ".vz"}) {
        if (free) out << "," << joint.name() << suffix;
      }
      if (!free) out << "," << joint.name() << ".dot";
    }
    for (const v1::SceneContact& contact : scene.contacts()) {
      for (const char* suffix : {".active", ".gap", ".px", ".py", ".pz", ".fx", ".fy", ".fz"}) {
        out << "," << contact.name() << suffix;
      }
    }
    out << ",kinetic_j,potential_j,work_j\n";
  }

  void Write(const v1::SimulationMessage& message) {
    if (json_) {
      out_ << ToJsonLine(message) << "\n";
      return;
    }
    for (const v1::SimulationSample& sample : message.samples().samples()) {
      out_ << FormatNumber(sample.time_s(), 17);
      for (const double value : sample.positions()) Cell(value);
      for (const double value : sample.velocities()) Cell(value);
      for (const v1::ContactSample& contact : sample.contacts()) {
        out_ << (contact.active() ? ",1" : ",0");
        Cell(contact.gap_m());
        for (const v1::Vector3* v : {&contact.point_m(), &contact.force_n()}) Cell(v->x()), Cell(v->y()), Cell(v->z());
      }
      Cell(sample.kinetic_energy_j());
      Cell(sample.potential_energy_j());
      Cell(sample.work_j());
      out_ << "\n";
    }
  }

 private:
  void Cell(double value) { out_ << "," << FormatNumber(value, 17); }

  const bool json_;
  std::ostream& out_;
};

std::string EventText(const v1::SimulationEvent& event) {
  std::string text = FormatNumber(event.time_s(), 12) + " s  " + event.contact() + " ";
  switch (event.kind()) {
    case v1::SimulationEvent::KIND_TOUCH_DOWN:
      text += "touches down, " + FormatNumber(event.energy_loss_j()) + " J lost";
      break;
    case v1::SimulationEvent::KIND_LIFT_OFF:
      return text + "lifts off";
    case v1::SimulationEvent::KIND_FRICTION_LOST:
      return text + "needs more friction than there is";
    case v1::SimulationEvent::KIND_FRICTION_REGAINED:
      return text + "has enough friction again";
    case v1::SimulationEvent::KIND_STUCK:
      return text + "slides no longer";
    default:
      return text + "has an event that this client does not know";
  }
  std::string released;
  for (const auto& impulse : event.impulses()) {
    if (impulse.released()) {
      released += "; " + impulse.contact() + " released at " + FormatNumber(impulse.gap_rate_after_m_s()) + " m/s";
    } else {
      const v1::Vector3& j = impulse.impulse_n_s();
      text += "; impulse on " + impulse.contact() + " (" + FormatNumber(j.x()) + ", " + FormatNumber(j.y()) + ", " +
              FormatNumber(j.z()) + ") N s";
    }
  }
  text += released;
  if (event.redundant()) text += "; the impulses are not unique";
  if (!event.consistent()) text += "; no set of contacts pushes and separates: the impact is not physical";
  return text;
}

std::string ReportText(const v1::SimulationReport& report) {
  std::vector<std::vector<std::string>> rows = {
      {"end", FormatNumber(report.end_time_s(), 12), "s", SimulationEndText(report.end())},
      {"steps", std::to_string(report.steps()), "",
       std::to_string(report.rejected_steps()) + " rejected, " + std::to_string(report.evaluations()) + " evaluations"},
      {"impacts", std::to_string(report.impacts()), "", ""},
      {"energy", FormatNumber(report.energy_initial_j(), 8), "J",
       "at the end " + FormatNumber(report.energy_final_j(), 8)},
      {"energy error", FormatNumber(report.max_energy_error_j(), 3), "J",
       "largest |energy - work - energy at the start|"},
      {"gap", FormatNumber(report.max_gap_m(), 3), "m", "largest of active contacts"},
      {"slip", FormatNumber(report.max_slip_m_s(), 3), "m/s", "largest of active contacts"}};
  if (report.has_min_normal_force_n()) {
    rows.push_back(
        {"least normal force", FormatNumber(report.min_normal_force_n()), "N",
         report.min_normal_force_contact() + " at " + FormatNumber(report.min_normal_force_time_s()) + " s"});
    rows.push_back(
        {"friction needed", FormatNumber(report.max_friction_ratio()), "",
         report.max_friction_ratio_contact() + " at " + FormatNumber(report.max_friction_ratio_time_s()) + " s"});
  }
  if (report.redundant()) rows.push_back({"contacts", "redundant", "", "the forces are not unique"});
  return FormatTable(rows, "lr");
}

}  // namespace

ExitCode RunSimulate(const SimulateOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  v1::SimulateRequest request;
  *request.mutable_scene() = ReadScene(options.scene);
  if (options.max_wall_time_s) request.set_max_wall_time_s(*options.max_wall_time_s);
  request.set_validate_only(options.validate_only);

  RequireOneDocument(options.output, global.json);
  const bool document_alone = IsStandardOutput(options.output);  // in place of the samples
  std::optional<SimulationDocument> document;
  if (!options.output.empty() && !document_alone && !options.validate_only)
    document.emplace(options.output, request.scene(), terminal.out);
  grpc::ClientContext context;
  const Interrupt interrupt([&](int) { context.TryCancel(); });
  Connection connection(global);
  const auto stream = connection.stub().Simulate(&context, request);
  if (options.validate_only) {
    v1::SimulationMessage unused;
    while (stream->Read(&unused)) {
    }
    RequireOk(stream->Finish(), "simulate the scene", connection.server(), CallKind::kScene);
    if (!global.quiet) terminal.out << "the scene is valid" << std::endl;
    return ExitCode::kSuccess;
  }
  std::optional<SampleWriter> writer;
  v1::SimulationMessage message;
  v1::SimulationReport report;
  const bool live = terminal.err_live && !global.quiet;
  while (stream->Read(&message)) {
    if (!writer && !document_alone) writer.emplace(request.scene(), global.json, terminal.out);
    if (writer) writer->Write(message);
    // Standard output gets nothing of a scene that is refused.
    if (document_alone && !document) document.emplace(options.output, request.scene(), terminal.out);
    if (document) document->Add(message);
    if (live && message.has_samples()) {
      const double time = message.samples().samples(message.samples().samples_size() - 1).time_s();
      terminal.err << "\r" << FormatNumber(time, 6) << " of " << FormatNumber(request.scene().duration_s(), 6)
                   << " s\x1b[K" << std::flush;
    }
    if (message.has_event() && !global.quiet)
      terminal.err << (live ? "\r\x1b[K" : "") << EventText(message.event()) << std::endl;
    if (message.has_report()) report = message.report();
  }
  if (live) terminal.err << "\r\x1b[K";
  RequireOk(stream->Finish(), "simulate the scene", connection.server(), CallKind::kScene);
  terminal.out.flush();
  if (document) document->Finish(report);
  if (!global.quiet) terminal.err << ReportText(report);
  return IsCompleted(report.end()) ? ExitCode::kSuccess : ExitCode::kNoSolution;
}

}  // namespace rollgait::client
