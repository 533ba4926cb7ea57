#include "core/validation/normative_data.h"

#include <optional>
#include <sstream>

#include "core/base/check.h"
#include "core/validation/normative_table.h"

namespace rollgait {
namespace {

std::vector<NormativeDataset> Described() {
  return {
      {"Winter_BioMAC",
       "Winter's normal walkers as in the BioMAC-Sim-Toolbox (data/Walking/Winter_normal.mat, Apache-2.0): angles and "
       "ground forces",
       "between persons; of the forces at least 5 % of body weight",
       1.325,
       1.1396,
       56.7,
       {}},
      {"Falisse2019_subject1",
       "Falisse et al. 2019, one subject, 11 trials (3dpredictsim ExperimentalData.mat, MIT): angles, moments, ground "
       "forces; speed as recalled from the paper, stride time from the stride of 1.377 m",
       "between trials of one person",
       1.33,
       1.377 / 1.33,
       62,
       {}},
  };
}

std::optional<NormativeQuantity> QuantityOf(const std::string& plane, const std::string& quantity) {
  if (plane == "GRF_vertical") return NormativeQuantity::kVerticalForce;
  if (plane == "GRF_fore_aft") return NormativeQuantity::kForwardForce;
  if (plane != "sagittal") return std::nullopt;
  if (quantity == "angle") return NormativeQuantity::kAngle;
  if (quantity == "moment_extensor_positive") return NormativeQuantity::kMoment;
  return std::nullopt;
}

bool IsOfTheLeg(const std::string& joint) {
  return joint == "hip" || joint == "knee" || joint == "ankle" || joint == "foot";
}

NormativeCurve* CurveOf(NormativeDataset* set, NormativeQuantity quantity, const std::string& joint) {
  for (NormativeCurve& curve : set->curves) {
    if (curve.quantity == quantity && curve.joint == joint) return &curve;
  }
  set->curves.push_back({quantity, joint, {}, {}});
  return &set->curves.back();
}

// Columns: dataset, speed_m_s, joint, plane_or_component, quantity, unit, pct_cycle, mean, sd. The sample at 100 %,
// where there is one, repeats the one at 0 %.
std::vector<NormativeDataset> Read() {
  std::vector<NormativeDataset> sets = Described();
  std::istringstream table(kNormativeTable);
  for (std::string line; std::getline(table, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("dataset,")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line);
    for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
    ROLLGAIT_CHECK(cells.size() == 9);
    const auto quantity = QuantityOf(cells[3], cells[4]);
    if (!quantity || !IsOfTheLeg(cells[2]) || cells[6] == "100") continue;
    NormativeDataset* set = nullptr;
    for (NormativeDataset& candidate : sets) {
      if (candidate.name == cells[0]) set = &candidate;
    }
    ROLLGAIT_CHECK(set != nullptr && set->speed == std::stod(cells[1]));
    NormativeCurve* curve = CurveOf(set, *quantity, cells[2]);
    ROLLGAIT_CHECK(std::stod(cells[6]) == 2.0 * static_cast<double>(curve->mean.size()));
    curve->mean.push_back(std::stod(cells[7]));
    curve->deviation.push_back(std::stod(cells[8]));
  }
  for (const NormativeDataset& set : sets) {
    for (const NormativeCurve& curve : set.curves) ROLLGAIT_CHECK(curve.mean.size() == kNormativeSamples);
  }
  return sets;
}

}  // namespace

const std::vector<NormativeDataset>& NormativeDatasets() {
  static const std::vector<NormativeDataset> sets = Read();
  return sets;
}

}  // namespace rollgait
