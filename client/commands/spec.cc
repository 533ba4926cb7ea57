#include <google/protobuf/util/message_differencer.h>

#include "client/commands/commands.h"
#include "client/commands/create_solve.h"
#include "client/json.h"
#include "client/output.h"

namespace rollgait::client {
namespace {

// The request with its preset spelled out by the server; as it is, with a word on terminal.err, where none answers.
v1::SolveSpec SpelledOut(const v1::SolveSpec& spec, const GlobalOptions& global, const Terminal& terminal) {
  Connection connection(global);
  v1::CreateSolveRequest request;
  *request.mutable_spec() = spec;
  request.set_validate_only(true);
  request.set_spell_out(true);
  try {
    v1::SolveSpec spelled = CreateSolve(connection, request).spec();
    if (!global.quiet && google::protobuf::util::MessageDifferencer::Equals(spelled, spec)) {
      terminal.err << "rollgait: the server left the request as it is: it was spelled out already, or the server is of "
                      "0.4.0 or before and cannot"
                   << std::endl;
    } else if (!global.quiet && spelled.preset() != v1::PRESET_UNSPECIFIED) {
      terminal.err << "rollgait: the preset stays beside its costs, since it also scales limits and passive torques to "
                      "this gravity"
                   << std::endl;
    }
    return spelled;
  } catch (const Failure& failure) {
    if (failure.code() != ExitCode::kUnreachable) throw;
    terminal.err << "rollgait: the preset is not spelled out and nothing is checked: " << failure.what() << std::endl;
    return spec;
  }
}

}  // namespace

ExitCode RunSpec(const SpecOptions& options, const GlobalOptions& global, const Terminal& terminal) {
  if (!options.output.empty()) RequireOutput(options.output, FindFormat("json"));
  v1::SolveSpec spec = BuildSpec(options.spec);
  if (spec.preset() != v1::PRESET_UNSPECIFIED && !options.keep_preset) spec = SpelledOut(spec, global, terminal);
  WriteDocument(ToJsonText(spec), options.output, terminal.out);
  return ExitCode::kSuccess;
}

}  // namespace rollgait::client
