#include "client/paper/statements.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "client/text.h"

namespace rollgait::client {
namespace {

enum Slope { kUphill, kLevel, kDownhill, kSlopes };
constexpr const char* kNames[kSlopes] = {"+10°", "0°", "−10°"};

struct Gaits {
  const std::vector<v1::Solve>& solves;
  const std::vector<SlopeFigures>& figures;

  bool All() const {
    return std::all_of(figures.begin(), figures.end(), [](const SlopeFigures& f) { return f.solved; });
  }
  // "+10°: …; 0°: …; −10°: …"
  std::string Each(const std::function<std::string(int)>& text) const {
    std::string line;
    for (int i = 0; i < kSlopes; ++i) line += (line.empty() ? "" : "; ") + std::string(kNames[i]) + ": " + text(i);
    return line;
  }
  double Largest(const std::function<double(int)>& value) const {
    double largest = value(0);
    for (int i = 1; i < kSlopes; ++i) largest = std::max(largest, value(i));
    return largest;
  }
};

// A motion whose feet slip this much of its speed between the nodes exists on its mesh only.
constexpr double kArtefact = 0.05;

// Why the motions tell nothing of walking; empty if they do.
std::string Doubt(const Gaits& gaits) {
  if (!gaits.All()) return "Not all three gaits were found.";
  double worst = 0;
  for (const v1::Solve& solve : gaits.solves) {
    worst = std::max(worst, solve.result().accuracy().max_slip_m_s() / solve.result().speed_m_s());
  }
  if (worst <= kArtefact) return "";
  return "These motions exist on their mesh only: between its nodes the feet slip by " + FormatNumber(100 * worst, 2) +
         " % of the speed. Ask for --accuracy standard.";
}

Agreement Judge(bool agrees) { return agrees ? Agreement::kAgrees : Agreement::kDisagrees; }

std::string Percent(const std::optional<double>& percent) {
  return percent ? FormatNumber(*percent, 3) + " %" : std::string("none");
}

Statement Skeleton(const Gaits& gaits) {
  const v1::ModelSummary& model = gaits.solves[0].result().model().summary();
  Statement s{"3.2", "The avatar has 29 degrees of freedom, 23 of them actuated, and ellipsoidal feet.",
              std::to_string(model.degrees_of_freedom()) + " degrees of freedom, " +
                  std::to_string(model.actuated_joints()) + " actuated (model " + model.name() + ")",
              Agreement::kOpen, ""};
  s.agreement = Judge(model.degrees_of_freedom() == 29 && model.actuated_joints() == 23);
  s.why = s.agreement == Agreement::kAgrees ? "The same counts; the paper does not list its joints."
                                            : "Another model was asked for; human29 has the paper's counts.";
  return s;
}

Statement Cost(const Gaits& gaits) {
  Statement s{"4.2", "The cost is the squared torque, weighted joint by joint.", "", Agreement::kOpen, ""};
  bool torque = true;
  for (const v1::CostValue& cost : gaits.solves[0].result().costs()) {
    torque = torque && cost.name() == "squared torque";
    s.ours += (s.ours.empty() ? "" : ", ") + cost.name();
  }
  s.agreement = Judge(torque);
  s.why =
      torque
          ? "The paper fits the weights to torques of people and does not print them; ours are in the request, 1 if it "
            "names none."
          : "Another cost was asked for.";
  return s;
}

Statement TwoPhases(const Gaits& gaits) {
  Statement s{"4.2", "Only two kinds of phases are needed: single and double support.", "", Agreement::kOpen, ""};
  const auto counts = [&](int i) {
    std::string text;
    for (const PhaseShare& phase : gaits.figures[i].phases) {
      text += (text.empty() ? "" : ", ") + std::string(phase.feet == 1   ? "single"
                                                       : phase.feet == 2 ? "double"
                                                                         : "flight");
    }
    return text;
  };
  bool two = true;
  for (const SlopeFigures& figures : gaits.figures) {
    for (const PhaseShare& phase : figures.phases) two = two && (phase.feet == 1 || phase.feet == 2);
  }
  s.ours = gaits.Each(counts);
  s.agreement = Judge(two);
  s.why = "The sequence of contacts is part of the request, as in the paper.";
  return s;
}

Statement Durations(const Gaits& gaits) {
  constexpr double kSame = 1;  // % of the cycle
  Statement s{"4.2", "The relative durations of the phases on the complete cycle are not the same on the three slopes.",
              "", Agreement::kOpen, ""};
  const auto both = [&](int i) {
    double sum = 0;
    for (const PhaseShare& phase : gaits.figures[i].phases) {
      sum += phase.feet == 2 ? phase.end_percent - phase.start_percent : 0;
    }
    return sum;
  };
  s.ours = gaits.Each([&](int i) { return "double support " + FormatNumber(both(i), 3) + " % of the cycle"; });
  const double spread = gaits.Largest(both) + gaits.Largest([&](int i) { return -both(i); });
  s.agreement = Judge(spread > kSame);
  s.why = "The shares of double support differ by " + FormatNumber(spread, 2) + " % of the cycle; differences up to " +
          FormatNumber(kSame) + " % count as the same.";
  return s;
}

Statement HeelStrike(const Gaits& gaits) {
  constexpr double kPaper[kSlopes] = {55, 40, 55}, kNear = 3;  // % of the cycle; the paper says "around"
  Statement s{"4.2", "Heel strike is at around 40 % of the cycle on the flat, at 55 % on the two slopes.", "",
              Agreement::kOpen, ""};
  bool near = true, mirrored = true;
  for (int i = 0; i < kSlopes; ++i) {
    const std::optional<double>& strike = gaits.figures[i].events.opposite_heel_strike;
    near = near && strike && std::abs(*strike - kPaper[i]) <= kNear;
    mirrored = mirrored && gaits.figures[i].mirrored;
  }
  s.ours = gaits.Each([&](int i) { return Percent(gaits.figures[i].events.opposite_heel_strike); }) +
           " (of the left foot; toe-off of the right foot " +
           gaits.Each([&](int i) { return Percent(gaits.figures[i].events.toe_off); }) + ")";
  s.agreement = Judge(near);
  s.why =
      mirrored
          ? "Our left and right steps are mirror images, as in healthy walking, so the heel strike halves the cycle. "
            "The paper closes the whole cycle only, and asks for no symmetry."
          : "Within " + FormatNumber(kNear) + " % of the cycle counts as agreement.";
  return s;
}

Statement DownhillEffort(const Gaits& gaits) {
  Statement s{"4.2", "Torque consumption is larger downhill than uphill.", "", Agreement::kOpen, ""};
  const auto squared = [&](int i) { return gaits.figures[i].total.squared / gaits.figures[i].stride_length_m; };
  const auto absolute = [&](int i) { return gaits.figures[i].total.absolute / gaits.figures[i].stride_length_m; };
  s.ours = gaits.Each([&](int i) {
    return "∫τ² " + FormatNumber(squared(i), 4) + " N² m s, ∫|τ| " + FormatNumber(absolute(i), 4) + " N s";
  }) + " per metre";
  const double ratio = squared(kDownhill) / squared(kUphill), second = absolute(kDownhill) / absolute(kUphill);
  s.agreement = Judge(ratio > 1);
  s.why = "Downhill over uphill: " + FormatNumber(ratio, 3) + " in squared torque, which is what is minimised, and " +
          FormatNumber(second, 3) + " in absolute torque" +
          ((ratio > 1) == (second > 1) ? "." : ": the two measures differ.") +
          " The paper's weights of the joints are not printed.";
  return s;
}

Statement SlowingDown(const Gaits& gaits) {
  Statement s{"4.2", "Downhill requires slowing the body down.", "", Agreement::kOpen, ""};
  const auto work = [&](int i) {
    const JointEffort& total = gaits.figures[i].total;
    return (total.positive_work - total.negative_work) / gaits.figures[i].stride_length_m;
  };
  s.ours = gaits.Each([&](int i) { return "net joint work " + FormatNumber(work(i), 3) + " J per metre"; });
  s.agreement = Judge(work(kDownhill) < 0 && work(kUphill) > 0);
  s.why =
      "Net work of the joints is negative where they brake. By conservation of energy it is weight × sin(slope) per "
      "metre, "
      "less what passive joints and impacts take.";
  return s;
}

Statement TorqueAxes(const Gaits& gaits) {
  constexpr double kAxis = 100;  // N m
  Statement s{"Figure 2", "Torques of hip, knee and ankle are drawn between −100 and 100 N m.", "", Agreement::kOpen,
              ""};
  const auto peak = [&](int i) { return gaits.figures[i].total.peak; };
  s.ours = gaits.Each([&](int i) { return "largest " + FormatNumber(peak(i), 3) + " N m"; });
  const double largest = gaits.Largest(peak);
  s.agreement = Judge(largest <= kAxis);
  s.why = largest <= kAxis
              ? "Every peak is inside the paper's axes."
              : "Our largest peak, " + FormatNumber(largest, 3) +
                    " N m, is outside. The paper gives neither body mass nor speed, and no values of its curves.";
  return s;
}

Statement Rolling(const Gaits& gaits) {
  constexpr double kGap_m = 1e-4, kSlip_m_s = 1e-3;
  Statement s{"2, 5", "The feet roll without slipping; the contact model is exact.", "", Agreement::kOpen, ""};
  const auto accuracy = [&](int i) -> const v1::AccuracyReport& { return gaits.solves[i].result().accuracy(); };
  s.ours = gaits.Each([&](int i) {
    return "slip " + FormatNumber(1e3 * accuracy(i).max_slip_m_s(), 2) + " mm/s, gap " +
           FormatNumber(1e3 * accuracy(i).max_gap_m(), 2) + " mm";
  });
  s.agreement = Judge(gaits.Largest([&](int i) { return accuracy(i).max_slip_m_s(); }) <= kSlip_m_s &&
                      gaits.Largest([&](int i) { return accuracy(i).max_gap_m(); }) <= kGap_m);
  s.why = "Largest values between the nodes of the mesh, against 1 mm/s and 0.1 mm" +
          std::string(s.agreement == Agreement::kAgrees ? "." : "; ask for --accuracy standard and more intervals.");
  return s;
}

Statement Periodic(const Gaits& gaits) {
  constexpr double kClosed = 1e-6;
  Statement s{"4.1, eq. 4.2", "The motion is periodic: x(0) = x(T).", "", Agreement::kOpen, ""};
  const auto error = [&](int i) { return gaits.solves[i].result().accuracy().periodicity_error(); };
  s.ours = gaits.Each([&](int i) { return "error " + FormatNumber(error(i), 2); });
  s.agreement = Judge(gaits.Largest(error) <= kClosed);
  s.why =
      "Up to the way walked, which the equation taken literally forbids; largest difference in rad, m, rad/s, m/s, "
      "against 1e-6.";
  return s;
}

Statement EntryPoints(const Gaits& gaits) {
  Statement s{"4.2, eq. 4.3",
              "The points of the ellipsoid that touch the ground at the beginning of each phase are imposed.", "",
              Agreement::kOpen, ""};
  const v1::GroundContact& contact = gaits.solves[0].spec().ground_contact();
  const bool imposed =
      contact.has_touch_down_point() && contact.touch_down_point().min() == contact.touch_down_point().max();
  s.agreement = Judge(imposed);
  s.ours =
      imposed ? "imposed at " + FormatNumber(contact.touch_down_point().min(), 3) + " of the semi-axis" : "left free";
  s.why = imposed ? "As the request asks." : "The paper does not say which points; --touch-down-point imposes them.";
  return s;
}

Statement Time(const Gaits& gaits) {
  constexpr double kMinutes = 20;
  Statement s{"4.2", "Each scenario was computed in less than 20 minutes on a modern computer.", "", Agreement::kOpen,
              ""};
  const auto seconds = [&](int i) { return gaits.figures[i].wall_time_s; };
  s.ours = gaits.Each([&](int i) { return FormatDuration(seconds(i)); });
  s.agreement = Judge(gaits.Largest(seconds) < 60 * kMinutes);
  s.why = "Wall time of the solver, every mesh included.";
  return s;
}

Statement Polyhedra(const Gaits&) {
  return {"5", "With ellipsoids in place of polyhedra the algorithms run faster and give better results.",
          "no polyhedral feet here", Agreement::kOpen,
          "There is nothing to compare with: this library has smooth feet only."};
}

}  // namespace

std::string AgreementName(Agreement agreement) {
  switch (agreement) {
    case Agreement::kAgrees:
      return "agrees";
    case Agreement::kDisagrees:
      return "disagrees";
    case Agreement::kOpen:
      return "open";
  }
  return "";
}

std::vector<Statement> CompareStatements(const std::vector<v1::Solve>& solves,
                                         const std::vector<SlopeFigures>& figures) {
  using Compare = Statement (*)(const Gaits&);
  constexpr Compare kOfTheRun[] = {Skeleton, Cost, TwoPhases, Rolling, Periodic, EntryPoints, Time, Polyhedra};
  constexpr Compare kOfTheMotion[] = {Durations, HeelStrike, DownhillEffort, SlowingDown, TorqueAxes};
  const Gaits gaits{solves, figures};
  std::vector<Statement> statements;
  const auto add = [&](Compare compare, const std::string& doubt) {
    Statement statement = compare(gaits);
    if (!doubt.empty() && statement.agreement != Agreement::kOpen) {
      statement.agreement = Agreement::kOpen;
      statement.why = doubt;
    }
    statements.push_back(statement);
  };
  const std::string doubt = Doubt(gaits);
  for (const Compare compare : kOfTheMotion) add(compare, doubt);
  for (const Compare compare : kOfTheRun) add(compare, gaits.All() ? "" : doubt);
  return statements;
}

}  // namespace rollgait::client
