#ifndef ROLLGAIT_SERVER_SERVICE_SOLVE_KEY_H_
#define ROLLGAIT_SERVER_SERVICE_SOLVE_KEY_H_

#include <google/protobuf/message.h>

#include <string>

#include "rollgait/v1/model.pb.h"
#include "rollgait/v1/solve_spec.pb.h"

namespace rollgait::server {

// The message as bytes that are equal for equal messages: map entries in the order of their keys.
std::string CanonicalBytes(const google::protobuf::Message& message);

// SHA-256 of request, model, build of the solver and, unless they are empty, the start and the tenant, as hexadecimal
// digits. Equal keys: the same program given the same question about the same body and the same start by the same
// tenant.
std::string SolveKey(const v1::SolveSpec& spec, const v1::Model& model, const std::string& solver_build,
                     const std::string& start = "", const std::string& tenant = "");

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_SOLVE_KEY_H_
