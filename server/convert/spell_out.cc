#include "server/convert/spell_out.h"

#include "core/gait/combined_costs.h"
#include "core/gait/presets.h"
#include "server/convert/cost_convert.h"
#include "server/convert/gait_request_convert.h"

namespace rollgait::server {

Result<v1::SolveSpec> SpellOut(const v1::SolveSpec& spec) {
  const Result<GaitSpec> checked = DecodeSpec(spec);
  if (!checked.ok()) return checked.violations();
  if (spec.preset() == v1::PRESET_UNSPECIFIED) return spec;
  const Result<GaitRequest> decoded = DecodeRequest(spec);
  if (!decoded.ok()) return decoded.violations();
  GaitRequest request = decoded.value();
  FillFromPreset(&request);
  v1::SolveSpec spelled = spec;
  if (request.body.feet) {
    spelled.mutable_model()->set_feet(*request.body.feet == FootShape::kTwoEllipsoids
                                          ? v1::ModelSelection::FEET_TWO_ELLIPSOIDS
                                          : v1::ModelSelection::FEET_ONE_ELLIPSOID);
  }
  if (request.motion.duty_factor) {
    spelled.mutable_motion()->mutable_duty_factor()->set_min(request.motion.duty_factor->min);
    spelled.mutable_motion()->mutable_duty_factor()->set_max(request.motion.duty_factor->max);
  }
  if (request.ground_contact.swing_clearance) {
    spelled.mutable_ground_contact()->set_swing_clearance_m(*request.ground_contact.swing_clearance);
  }
  spelled.clear_costs();
  for (const CombinedCost& combined : CombineCosts(request, &checked.value().scene, checked.value().similarity)) {
    *spelled.add_costs() = EncodeCost(combined.cost);
  }
  if (checked.value().similarity.gravity == 1) spelled.clear_preset();
  return spelled;
}

}  // namespace rollgait::server
