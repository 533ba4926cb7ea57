#include "client/paper/paper_page.h"

#include "client/paper/slope_figures.h"
#include "client/paper/statements.h"
#include "client/report/report.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

constexpr int kTorqueIntervals = 100;

json EffortData(const JointEffort& effort) {
  return {{"joint", effort.joint},
          {"squared_torque_n2m2s", effort.squared},
          {"absolute_torque_nms", effort.absolute},
          {"positive_work_j", effort.positive_work},
          {"negative_work_j", effort.negative_work},
          {"peak_torque_nm", effort.peak}};
}

json Optional(const std::optional<double>& value) { return value ? json(*value) : json(); }

// Of hip, knee and ankle of the right leg, where the model has them.
json TorqueData(const v1::Solve& solve) {
  const v1::Model& model = solve.result().model();
  const Stride stride =
      BuildStride(solve.result().trajectory(), model, solve.result().gait_events().start_s(), kTorqueIntervals);
  json torques = json::object();
  for (const StrideSample& sample : stride.samples) torques["percent"].push_back(sample.percent);
  for (const char* const name : {"hip", "knee", "ankle"}) {
    for (int j = 0; j < model.joints_size(); ++j) {
      if (model.joints(j).name() != std::string(name) + "_r") continue;
      for (const StrideSample& sample : stride.samples) torques[name].push_back(sample.instant.effort[j]);
    }
  }
  return torques;
}

json SlopeData(const v1::Solve& solve, const SlopeFigures& figures) {
  json data = {{"slope_deg", figures.slope_deg},
               {"solve", figures.solve},
               {"solved", figures.solved},
               {"wall_time_s", figures.wall_time_s}};
  if (figures.phases.empty()) return data;
  data["stride_time_s"] = figures.stride_time_s;
  data["stride_length_m"] = figures.stride_length_m;
  data["events_percent"] = {{"heel_strike", 0},
                            {"opposite_toe_off", Optional(figures.events.opposite_toe_off)},
                            {"opposite_heel_strike", Optional(figures.events.opposite_heel_strike)},
                            {"toe_off", Optional(figures.events.toe_off)}};
  for (const PhaseShare& phase : figures.phases) {
    data["phases"].push_back({{"start_percent", phase.start_percent},
                              {"end_percent", phase.end_percent},
                              {"duration_s", phase.duration_s},
                              {"feet", phase.feet},
                              {"contacts", phase.contacts}});
  }
  for (const JointEffort& effort : figures.joints) data["joints"].push_back(EffortData(effort));
  data["total"] = EffortData(figures.total);
  data["torques"] = TorqueData(solve);
  return data;
}

}  // namespace

json PaperData(const std::vector<v1::Solve>& solves) {
  std::vector<SlopeFigures> figures;
  json slopes = json::array(), statements = json::array();
  for (const v1::Solve& solve : solves) {
    figures.push_back(MeasureSlope(solve));
    slopes.push_back(SlopeData(solve, figures.back()));
  }
  for (const Statement& statement : CompareStatements(solves, figures)) {
    statements.push_back({{"where", statement.where},
                          {"paper", statement.paper},
                          {"ours", statement.ours},
                          {"verdict", AgreementName(statement.agreement)},
                          {"why", statement.why}});
  }
  return {{"slopes", slopes}, {"statements", statements}};
}

std::string PaperHtml(const std::vector<v1::Solve>& solves) {
  return PageHtml({solves.begin(), solves.end()}, "Figure 2 of the paper, computed again", PaperData(solves));
}

}  // namespace rollgait::client
