#include "server/service/core_knowledge.h"

#include "server/convert/gait_request_convert.h"
#include "server/convert/joint_chains.h"
#include "server/convert/model_convert.h"
#include "server/convert/spell_out.h"
#include "server/convert/warm_start_convert.h"

namespace rollgait::server {
namespace {

// The default of rollgait.v1.SolveSpec.gravity_m_s2.
constexpr double kStandardGravity = 9.81;

Result<v1::Model> CheckSpec(const v1::SolveSpec& message) {
  const Result<GaitSpec> spec = DecodeSpec(message);
  if (!spec.ok()) return spec.violations();
  return EncodeModel(spec.value().scene, spec.value().gravity.norm());
}

Violations CheckWarmStart(const v1::SolveSpec& message, const v1::SolveResult& result) {
  const Result<GaitSpec> spec = DecodeSpec(message);
  if (!spec.ok()) return spec.violations();
  const Result<WarmStart> start = DecodeWarmStart(result.trajectory(), result.multipliers(), spec.value());
  return start.ok() ? Violations() : start.violations();
}

v1::ListModelsResponse ListModels() {
  v1::ListModelsResponse response;
  for (const CatalogEntry& entry : ListCatalog()) *response.add_models() = EncodeSummary(entry);
  return response;
}

Result<v1::Model> GetModel(const v1::ModelSelection& selection) {
  const Result<BodyRequest> body = DecodeBody(selection);
  if (!body.ok()) return body.violations();
  const Result<Scene> scene = BuildScene(body.value());
  if (!scene.ok()) return scene.violations();
  return EncodeModel(scene.value(), kStandardGravity);
}

v1::Model WithJointChains(const v1::Model& model) {
  Violations none;
  return UnfoldJointChains("", model, &none).model;
}

}  // namespace

GaitKnowledge MakeCoreKnowledge() {
  return {CheckSpec, CheckWarmStart, ListModels, GetModel, SpellOut, WithJointChains};
}

}  // namespace rollgait::server
