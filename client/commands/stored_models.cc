// models create, models delete: the caller's own models on the server.
#include "client/commands/model_commands.h"
#include "client/import/model_file.h"
#include "client/json.h"
#include "client/output.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr char kPrefix[] = "models/";

// "models/ID" of "ID".
std::string ModelName(const std::string& name) { return name.rfind(kPrefix, 0) == 0 ? name : kPrefix + name; }

}  // namespace

ExitCode RunCreateModel(const CreateModelOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  v1::CreateModelRequest request;
  ModelFile file = ReadModelFile(options.file, options.side_file);
  *request.mutable_model() = std::move(file.model);
  if (!global.quiet) terminal.err << file.explanation << std::flush;
  if (!options.id.empty()) request.set_model_id(ModelName(options.id).substr(sizeof(kPrefix) - 1));
  Connection connection(global);
  grpc::ClientContext context;
  connection.SetDeadline(context);
  v1::Model model;
  RequireOk(connection.stub().CreateModel(&context, request, &model), "create a model of " + options.file,
            connection.server());
  if (global.json) {
    terminal.out << ToJsonText(model) << std::flush;
  } else {
    terminal.out << model.summary().stored().name() << std::endl;
  }
  return ExitCode::kSuccess;
}

ExitCode RunDeleteModels(const std::vector<std::string>& names, const GlobalOptions& global, const Terminal& terminal) {
  ExitCode code = ExitCode::kSuccess;
  Connection connection(global);
  for (const std::string& name : names) {
    try {
      v1::DeleteModelRequest request;
      request.set_name(ModelName(name));
      grpc::ClientContext context;
      connection.SetDeadline(context);
      google::protobuf::Empty nothing;
      RequireOk(connection.stub().DeleteModel(&context, request, &nothing), "delete " + request.name(),
                connection.server());
    } catch (const Failure& failure) {
      terminal.err << "rollgait: " << failure.what() << std::endl;
      code = failure.code();
    }
  }
  return code;
}

}  // namespace rollgait::client
