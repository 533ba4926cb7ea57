#include <grpcpp/client_context.h>

#include <cmath>
#include <string>
#include <vector>

#include "client/commands/scene_input.h"
#include "client/commands/simulation_commands.h"
#include "client/interrupt.h"
#include "client/json.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

std::string GaitText(const v1::PeriodicGait& gait, const v1::SimulationScene& scene) {
  std::string text = gait.converged() ? "periodic gait after " + std::to_string(gait.iterations()) + " iterations\n\n"
                                      : "no periodic gait found; the best of " + std::to_string(gait.iterations()) +
                                            " iterations follows\n\n";
  std::vector<std::vector<std::string>> rows = {{"JOINT", "POSITION rad, m", "VELOCITY rad/s, m/s"}};
  for (int i = 0; i < scene.joints_size() && i < gait.positions_size(); ++i) {
    rows.push_back({scene.joints(i).name(), FormatNumber(gait.positions(i), 16), FormatNumber(gait.velocities(i), 16)});
  }
  text += FormatTable(rows, "lrr") + "\n";
  text += FormatTable({{"residual", FormatNumber(gait.residual(), 3), ""},
                       {"period", FormatNumber(gait.period_s(), 16), "s"},
                       {"step length", FormatNumber(gait.step_length_m(), 16), "m"},
                       {"heel strike takes", FormatNumber(gait.heel_strike().energy_loss_j(), 10), "J"},
                       {"least normal force", FormatNumber(gait.report().min_normal_force_n(), 10), "N"},
                       {"friction needed", FormatNumber(gait.report().max_friction_ratio(), 6), ""}},
                      "lr");
  text += "\neigenvalues of the step (" + std::string(gait.stable() ? "stable" : "not stable") + ")\n";
  for (const v1::PeriodicGait::Complex& value : gait.eigenvalues()) {
    text += "  " + FormatNumber(value.re(), 12);
    if (value.im() != 0) text += (value.im() < 0 ? " - " : " + ") + FormatNumber(std::abs(value.im()), 12) + " i";
    text += "\n";
  }
  return text;
}

}  // namespace

ExitCode RunPoincare(const PoincareOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  v1::FindPeriodicGaitRequest request;
  *request.mutable_scene() = ReadScene(options.scene);
  if (options.residual) request.set_residual(*options.residual);
  if (options.max_iterations) request.set_max_iterations(*options.max_iterations);
  if (options.max_wall_time_s) request.set_max_wall_time_s(*options.max_wall_time_s);
  grpc::ClientContext context;
  const Interrupt interrupt([&](int) { context.TryCancel(); });
  Connection connection(global);
  const auto stream = connection.stub().FindPeriodicGait(&context, request);
  v1::SimulationMessage message;
  v1::PeriodicGait gait;
  while (stream->Read(&message)) {
    if (global.json) terminal.out << ToJsonLine(message) << std::endl;
    if (message.has_gait_iteration() && !global.quiet) {
      terminal.err << "iteration " << message.gait_iteration().index() << "  residual "
                   << FormatNumber(message.gait_iteration().residual(), 3) << std::endl;
    }
    if (message.has_gait()) gait = message.gait();
  }
  RequireOk(stream->Finish(), "find a periodic gait", connection.server(), CallKind::kScene);
  if (!global.json && !global.quiet) terminal.out << GaitText(gait, request.scene()) << std::flush;
  return gait.converged() ? ExitCode::kSuccess : ExitCode::kNoSolution;
}

}  // namespace rollgait::client
