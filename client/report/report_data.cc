#include "client/report/report_data.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "client/accuracy_table.h"
#include "client/failure.h"
#include "client/json.h"
#include "client/program_log.h"
#include "client/report/gait_events_data.h"
#include "client/report/model_data.h"
#include "client/report/rolling_path.h"
#include "client/report/scene_data.h"
#include "client/report/stride_data.h"
#include "client/summary.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

using nlohmann::json;

std::string SlopeLabel(double slope_rad) {
  const double degrees = slope_rad * 180 / kPi;
  const std::string number = FormatNumber(std::abs(degrees), 3);
  return (number == "0" ? "" : degrees > 0 ? "+" : "−") + number + "°";
}

// The scheme that was asked for: trajectories of direct multiple shooting are returned as those of Hermite–Simpson.
v1::Discretization::Scheme SchemeOf(const v1::Solve& solve) {
  const v1::Discretization::Scheme asked = solve.spec().discretization().scheme();
  return asked == v1::Discretization::SCHEME_UNSPECIFIED ? solve.result().trajectory().scheme() : asked;
}

// One label a solve: the slope; with the speed, then with the name, where that is needed to tell them apart.
std::vector<std::string> Labels(const std::vector<ReportedSolve>& solves) {
  std::vector<std::string> labels;
  for (const ReportedSolve& at : solves) labels.push_back(SlopeLabel(at.solve.spec().slope_rad()));
  const auto ambiguous = [&labels] {
    return std::set<std::string>(labels.begin(), labels.end()).size() < labels.size();
  };
  if (ambiguous()) {
    for (size_t i = 0; i < solves.size(); ++i) {
      if (solves[i].solve.spec().has_manoeuvre()) continue;  // from rest to rest: no speed tells it from others
      labels[i] += ", " + FormatNumber(solves[i].solve.result().speed_m_s(), 3) + " m/s";
    }
  }
  if (ambiguous()) {
    for (size_t i = 0; i < solves.size(); ++i) {
      const std::string& name = solves[i].solve.name();
      labels[i] += ", " + (name.empty() ? "no. " + std::to_string(i + 1) : name);
    }
  }
  return labels;
}

json PairRows(const std::vector<std::pair<std::string, std::string>>& rows) {
  json list = json::array();
  for (const auto& [key, value] : rows) list.push_back({key, value});
  return list;
}

json RequestTable(const v1::SolveSpec& spec) {
  const v1::Motion& motion = spec.motion();
  std::vector<std::pair<std::string, std::string>> rows = {{"model", spec.model().name()},
                                                           {"slope", SlopeLabel(spec.slope_rad())}};
  if (motion.has_speed_m_s()) rows.emplace_back("speed", FormatNumber(motion.speed_m_s()) + " m/s");
  if (motion.free_speed()) rows.emplace_back("speed", "free");
  if (motion.has_step_length_m()) rows.emplace_back("step length", FormatNumber(motion.step_length_m()) + " m");
  if (motion.has_step_duration_s()) rows.emplace_back("step duration", FormatNumber(motion.step_duration_s()) + " s");
  if (spec.has_manoeuvre()) {
    const v1::Manoeuvre::State& end = spec.manoeuvre().end();
    rows.emplace_back("manoeuvre", "to (" + (end.has_x_m() ? FormatNumber(end.x_m()) : "free") + ", " +
                                       (end.has_y_m() ? FormatNumber(end.y_m()) : "free") + ") m, orientation " +
                                       (end.has_orientation() ? "given" : "free"));
  } else {
    rows.emplace_back("cycle", spec.cycle() == v1::CYCLE_FULL ? "full" : "half, mirrored");
  }
  if (spec.ground_contact().has_friction_coefficient()) {
    rows.emplace_back("friction", FormatNumber(spec.ground_contact().friction_coefficient()));
  }
  return PairRows(rows);
}

json CostTable(const v1::SolveResult& result) {
  json rows = json::array();
  for (const v1::CostValue& cost : result.costs()) {
    rows.push_back({{"name", cost.name()},
                    {"weight", cost.weight()},
                    {"value", cost.value()},
                    {"unsmoothed", cost.has_unsmoothed_value() ? cost.unsmoothed_value() : cost.value()},
                    {"unit", cost.unit()},
                    {"contribution", cost.contribution()}});
  }
  return rows;
}

json MeshTable(const v1::Solve& solve) {
  json rows = json::array();
  for (const v1::MeshStatistics& mesh : solve.result().meshes()) {
    std::string intervals;
    for (const int n : mesh.intervals()) intervals += (intervals.empty() ? "" : " + ") + std::to_string(n);
    const bool ended = mesh.termination() != v1::TERMINATION_UNSPECIFIED;
    rows.push_back({{"program", ProgramWords(solve, mesh)},
                    {"end", ended ? TerminationName(mesh.termination()) : ""},
                    {"intervals", intervals},
                    {"unknowns", mesh.unknowns()},
                    {"constraints", mesh.constraints()},
                    {"jacobian", mesh.jacobian_nonzeros()},
                    {"hessian", mesh.hessian_nonzeros()},
                    {"iterations", mesh.iterations()},
                    {"wall", FormatDuration(mesh.wall_time_s())},
                    {"evaluation", FormatDuration(mesh.evaluation_time_s())},
                    {"objective", mesh.objective()},
                    {"kkt", mesh.kkt_error()},
                    {"gap_mm", 1e3 * mesh.max_gap_m()},
                    {"slip_mm_s", 1e3 * mesh.max_slip_m_s()}});
  }
  return rows;
}

json AccuracyTable(const v1::Solve& solve) {
  json rows = json::array();
  for (const AccuracyLine& line : AccuracyLines(solve)) {
    rows.push_back({{"name", line.name},
                    {"value", line.value},
                    {"unit", line.unit},
                    {"where", line.where},
                    {"explanation", line.explanation},
                    {"bound", line.bound ? json(*line.bound) : json()},
                    {"exceeded", line.exceeded}});
  }
  return rows;
}

json UnmetTable(const v1::SolveResult& result) {
  json rows = json::array();
  for (const v1::UnmetConstraint& unmet : result.unmet_constraints()) {
    rows.push_back({{"name", unmet.name()},
                    {"violation", unmet.violation()},
                    {"unit", unmet.unit()},
                    {"phase", unmet.phase()},
                    {"time", unmet.time_s()}});
  }
  return rows;
}

json IterationTable(const std::vector<v1::Iteration>& iterations) {
  json rows = json::array();
  for (const v1::Iteration& at : iterations) {
    rows.push_back({at.index(), at.mesh(), at.objective(), at.primal_infeasibility(), at.dual_infeasibility(),
                    at.barrier_parameter(), at.elapsed_s()});
  }
  return rows;
}

// What belongs to one gait: the comparison without the data that it is compared with.
json OwnComparison(v1::NormativeComparison own) {
  if (own.datasets_size() == 0) return json();
  for (v1::NormativeDatasetComparison& set : *own.mutable_datasets()) {
    for (v1::NormativeCurve& curve : *set.mutable_curves()) {
      curve.clear_ours();
      curve.clear_mean();
      curve.clear_deviation();
    }
  }
  return json::parse(ToJsonLine(own));
}

// The data of the first gait that is compared with any.
json Datasets(const std::vector<ReportedSolve>& solves) {
  for (const ReportedSolve& at : solves) {
    if (at.solve.result().normative().datasets_size() == 0) continue;
    v1::NormativeComparison data;
    *data.mutable_datasets() = at.solve.result().normative().datasets();
    for (v1::NormativeDatasetComparison& set : *data.mutable_datasets()) {
      for (v1::NormativeCurve& curve : *set.mutable_curves()) curve.clear_ours();
    }
    return json::parse(ToJsonLine(data)).at("datasets");
  }
  return json::array();
}

// {duration, contact: [[x, y]], center: [[x, y]], couple: [N m], scene}
json PathData(const v1::SolveResult& result) {
  const RollingPath path = BuildRollingPath(result.trajectory(), result.model());
  json contact = json::array(), center = json::array(), couple = json::array();
  for (const RollingPath::Sample& at : path.samples) {
    contact.push_back({at.contact_x_m, at.contact_y_m});
    center.push_back({at.center_x_m, at.center_y_m});
    couple.push_back(at.couple_n_m);
  }
  return {{"duration", path.duration_s},
          {"contact", contact},
          {"center", center},
          {"couple", couple},
          {"scene", SceneData(path.instants, result.model(), {})}};
}

// The members of a gait: those of StrideData and of GaitEventsData, and scene.
json GaitData(const v1::SolveResult& result) {
  const v1::GaitEvents& events = result.gait_events();
  const Stride stride = BuildStride(result.trajectory(), result.model(), events.start_s(), kCycleSteps);
  std::vector<Instant> instants;
  for (const StrideSample& sample : stride.samples) instants.push_back(sample.instant);
  json data = StrideData(stride, result.model());
  data.update(GaitEventsData(events, result.model()));
  data["scene"] = SceneData(instants, result.model(), events);
  return data;
}

// The members of a solve that do not need its motion.
json SolveData(const ReportedSolve& reported, const std::string& label) {
  const v1::Solve& solve = reported.solve;
  const v1::SolveResult& result = solve.result();
  int iterations = 0;
  for (const v1::MeshStatistics& mesh : result.meshes()) iterations += mesh.iterations();
  const bool good = ExitCodeOf(solve) == ExitCode::kSuccess;
  json model = ModelData(result.model());
  if (!result.has_model()) model["name"] = solve.spec().model().name();
  return {{"name", solve.name()},
          {"label", label},
          {"slope_rad", solve.spec().slope_rad()},
          {"verdict", Verdict(solve)},
          {"good", good},
          {"accurate", VerdictName(result.accuracy().verdict())},
          {"accuracy_verdict", AccuracyVerdict(solve)},
          {"created", FormatTime(solve.create_time())},
          {"from_cache", solve.from_cache()},
          {"request", RequestTable(solve.spec())},
          {"spec", ToJsonText(solve.spec())},
          {"speed", result.speed_m_s()},
          {"step_length", result.step_length_m()},
          {"objective", result.objective()},
          {"iterations", iterations},
          {"wall_s", result.wall_time_s()},
          {"wall", FormatDuration(result.wall_time_s())},
          {"build", result.solver_build()},
          {"scheme", SchemeName(SchemeOf(solve))},
          {"costs", CostTable(result)},
          {"accuracy", result.has_accuracy() ? AccuracyTable(solve) : json::array()},
          {"meshes", MeshTable(solve)},
          {"log", IterationTable(reported.iterations)},
          {"unmet", UnmetTable(result)},
          {"people", OwnComparison(result.normative())},
          {"people_left", OwnComparison(result.normative_left())},
          {"model", model},
          {"stride", json()},
          {"path", json()}};
}

}  // namespace

json ReportData(const std::vector<ReportedSolve>& solves, const std::string& title) {
  const std::vector<std::string> labels = Labels(solves);
  json list = json::array();
  bool gaits = true;
  for (size_t i = 0; i < solves.size(); ++i) {
    json solve = SolveData(solves[i], labels[i]);
    const v1::SolveResult& result = solves[i].solve.result();
    const bool manoeuvre = solves[i].solve.spec().has_manoeuvre();
    gaits = gaits && !manoeuvre;
    if (result.has_trajectory() && result.trajectory().phases_size() > 0 && result.has_model()) {
      solve[manoeuvre ? "path" : "stride"] = manoeuvre ? PathData(result) : GaitData(result);
    }
    list.push_back(std::move(solve));
  }
  const std::string standard = !gaits ? "Optimal motions" : solves.size() == 1 ? "Optimal gait" : "Optimal gaits";
  return {{"title", title.empty() ? standard : title},
          {"program", "rollgait " ROLLGAIT_VERSION},
          {"datasets", Datasets(solves)},
          {"solves", list}};
}

json LiveData(const v1::Solve& solve) {
  return {{"title", "Solve in progress"},
          {"live", true},
          {"program", "rollgait " ROLLGAIT_VERSION},
          {"datasets", json::array()},
          {"solves", json::array({SolveData(solve, Labels({solve}).front())})}};
}

}  // namespace rollgait::client
