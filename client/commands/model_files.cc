// models check, models fit-feet: files of the caller's, of which nothing is stored.
#include "client/commands/commands.h"
#include "client/commands/model_commands.h"
#include "client/import/model_file.h"
#include "client/import/side_proposal.h"
#include "client/import/tree_file.h"
#include "client/json.h"
#include "client/report/surface_shape.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

std::string SemiAxes(const v1::Surface& surface) {
  const Eigen::Vector3d axes = ShapeOf(surface).semi_axes;
  return FormatNumber(axes.x()) + ", " + FormatNumber(axes.y()) + ", " + FormatNumber(axes.z());
}

}  // namespace

ExitCode RunCheckModel(const CheckModelOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!IsModelFile(options.file)) {
    throw Failure(ExitCode::kUsage, "models check: needs a file, .json or " + TreeFileEndings() +
                                        "; `rollgait models " + options.file + "` shows a model of the server");
  }
  ModelsOptions models;
  models.flags.model = options.file;
  models.flags.side_file = options.side_file;
  return RunModels(models, global, terminal);
}

ExitCode RunFitFeet(const std::string& file, const GlobalOptions& global, const Terminal& terminal) {
  if (!IsTreeFile(file)) {
    throw Failure(ExitCode::kUsage, "models fit-feet: needs a " + TreeFileEndings() + " file, not \"" + file + "\"");
  }
  const v1::ModelSideFile proposed = ProposeSideFile(ReadLinkTree(file)).side;
  if (proposed.contacts().empty()) {
    throw Failure(ExitCode::kUsage,
                  file + ": no feet are found to fit; `rollgait models " + file + " --propose-side` says why");
  }
  if (!global.quiet) {
    std::vector<std::vector<std::string>> rows = {{"CONTACT", "LINK", "SEMI-AXES m"}};
    for (const v1::SideContact& contact : proposed.contacts()) {
      rows.push_back({contact.name(), contact.link(), SemiAxes(contact.surface())});
    }
    terminal.err << FormatTable(rows, "") << std::flush;
  }
  v1::ModelSideFile feet;
  *feet.mutable_contacts() = proposed.contacts();
  terminal.out << ToJsonText(feet) << std::flush;
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
