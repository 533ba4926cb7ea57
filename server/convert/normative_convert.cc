#include "server/convert/normative_convert.h"

#include "core/base/check.h"

namespace rollgait::server {
namespace {

v1::NormativeCurve::Quantity EncodeQuantity(NormativeQuantity quantity) {
  switch (quantity) {
    case NormativeQuantity::kAngle:
      return v1::NormativeCurve::QUANTITY_ANGLE;
    case NormativeQuantity::kMoment:
      return v1::NormativeCurve::QUANTITY_MOMENT;
    case NormativeQuantity::kVerticalForce:
      return v1::NormativeCurve::QUANTITY_VERTICAL_FORCE;
    case NormativeQuantity::kForwardForce:
      return v1::NormativeCurve::QUANTITY_FORWARD_FORCE;
  }
  ROLLGAIT_CHECK(false);
}

void EncodeForcePeaks(const ForcePeaks& peaks, v1::ForcePeaks* encoded) {
  if (peaks.first) encoded->set_first_percent_bw(*peaks.first);
  if (peaks.valley) encoded->set_valley_percent_bw(*peaks.valley);
  if (peaks.second) encoded->set_second_percent_bw(*peaks.second);
  encoded->set_two_peaks(peaks.two);
}

void EncodeCurve(const CurveComparison& curve, v1::NormativeCurve* encoded) {
  encoded->set_quantity(EncodeQuantity(curve.quantity));
  encoded->set_joint(curve.joint);
  encoded->mutable_ours()->Add(curve.ours.begin(), curve.ours.end());
  encoded->mutable_mean()->Add(curve.mean.begin(), curve.mean.end());
  encoded->mutable_deviation()->Add(curve.deviation.begin(), curve.deviation.end());
  encoded->set_rms(curve.distance.rms);
  encoded->set_rms_deviations(curve.distance.rms_deviations);
  encoded->set_correlation(curve.distance.correlation);
  encoded->set_min(curve.min);
  encoded->set_max(curve.max);
  encoded->set_normative_min(curve.normative_min);
  encoded->set_normative_max(curve.normative_max);
}

}  // namespace

v1::NormativeComparison EncodeNormative(const NormativeComparison& comparison) {
  v1::NormativeComparison encoded;
  encoded.set_speed_m_s(comparison.speed);
  encoded.set_stride_time_s(comparison.stride_time);
  encoded.set_step_length_m(comparison.step_length);
  encoded.set_cadence_per_min(comparison.cadence);
  encoded.set_stance_fraction(comparison.stance);
  encoded.set_double_support_fraction(comparison.double_support);
  if (comparison.opposite_toe_off) encoded.set_opposite_toe_off_percent(*comparison.opposite_toe_off);
  if (comparison.opposite_heel_strike) encoded.set_opposite_heel_strike_percent(*comparison.opposite_heel_strike);
  if (comparison.toe_off) encoded.set_toe_off_percent(*comparison.toe_off);
  EncodeForcePeaks(comparison.peaks, encoded.mutable_vertical_force());
  for (const RestingJoint& resting : comparison.resting) {
    v1::RestingJoint* const joint = encoded.add_resting_joints();
    joint->set_joint(resting.joint);
    joint->set_at_max(resting.at_max);
    joint->set_stance_fraction(resting.share);
  }
  for (const DatasetComparison& dataset : comparison.datasets) {
    v1::NormativeDatasetComparison* const set = encoded.add_datasets();
    set->set_name(dataset.dataset);
    set->set_source(dataset.source);
    set->set_deviation(dataset.deviation);
    set->set_speed_m_s(dataset.speed);
    set->set_stride_time_s(dataset.stride_time);
    set->set_stance_fraction(dataset.stance);
    EncodeForcePeaks(dataset.peaks, set->mutable_vertical_force());
    for (const CurveComparison& curve : dataset.curves) EncodeCurve(curve, set->add_curves());
  }
  return encoded;
}

}  // namespace rollgait::server
