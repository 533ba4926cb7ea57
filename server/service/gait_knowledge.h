#ifndef ROLLGAIT_SERVER_SERVICE_GAIT_KNOWLEDGE_H_
#define ROLLGAIT_SERVER_SERVICE_GAIT_KNOWLEDGE_H_

#include <functional>

#include "core/base/result.h"
#include "rollgait/v1/gait_service.pb.h"

namespace rollgait::server {

// What the service asks of the physics, as messages; main.cc fills it from server/convert. Any thread may call.
struct GaitKnowledge {
  // The model that would walk; violations name fields relative to the spec.
  std::function<Result<v1::Model>(const v1::SolveSpec&)> check_spec;
  // What keeps a good spec from starting at the trajectory of a result; violations have the field "warm_start".
  std::function<Violations(const v1::SolveSpec&, const v1::SolveResult&)> check_warm_start;
  std::function<v1::ListModelsResponse()> list_models;
  // The scaled model; violations name fields relative to the selection.
  std::function<Result<v1::Model>(const v1::ModelSelection&)> get_model;
  // The spec with its preset spelled out (CreateSolveRequest.spell_out); violations as check_spec.
  std::function<Result<v1::SolveSpec>(const v1::SolveSpec&)> spell_out;
  // A good model with its universal and ball joints as chains (GetModelRequest.joint_chains).
  std::function<v1::Model(const v1::Model&)> with_joint_chains;
};

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_GAIT_KNOWLEDGE_H_
