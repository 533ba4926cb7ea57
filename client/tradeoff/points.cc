#include "client/tradeoff/points.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "client/failure.h"
#include "client/spec_words.h"
#include "client/sweep/grid.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

// The order in which a scheme comes to the optimum of efforts that are free: the finest mesh of the scheme of highest
// order is where the reference starts. Efforts that are constant in every interval come to it with order 2, whatever
// the steps.
struct SchemeOrder {
  v1::Discretization::Scheme scheme;
  int order;
};
constexpr SchemeOrder kOrders[] = {
    {v1::Discretization::SCHEME_RADAU2, 3},          {v1::Discretization::SCHEME_RADAU3, 5},
    {v1::Discretization::SCHEME_HERMITE_SIMPSON, 4}, {v1::Discretization::SCHEME_RADAU4, 7},
    {v1::Discretization::SCHEME_RADAU5, 9},          {v1::Discretization::SCHEME_LOBATTO4, 6},
    {v1::Discretization::SCHEME_LOBATTO5, 8},        {v1::Discretization::SCHEME_SHOOTING_CONSTANT, 2},
    {v1::Discretization::SCHEME_SHOOTING_LINEAR, 4}};

constexpr double kLeastTolerance = 1e-12, kMostTolerance = 1e-2;  // of the service

[[noreturn]] void Refuse(const std::string& flag, const std::string& text, const std::string& why) {
  throw Failure(ExitCode::kUsage, flag + " " + text + ": " + why);
}

std::vector<std::string> ParseSchemes(const std::string& text) {
  std::vector<std::string> schemes;
  std::istringstream stream(text + ",");
  for (std::string word; std::getline(stream, word, ',');) {
    if (SchemeWords().count(word) == 0) {
      Refuse("--scheme", text, "\"" + word + "\" must be one of " + Listed(SchemeWords()));
    }
    if (std::find(schemes.begin(), schemes.end(), word) != schemes.end()) {
      Refuse("--scheme", text, "has " + word + " twice");
    }
    OrderOf(word);  // Refuses a scheme without a row.
    schemes.push_back(word);
  }
  return schemes;
}

}  // namespace

std::vector<TradeoffPoint> MakeTradeoffPoints(const std::string& schemes, const std::string& intervals,
                                              const std::string& tolerances) {
  const std::vector<std::string> words = ParseSchemes(schemes);
  const std::vector<double> counts = ParseSweepValues("--intervals", intervals);
  const std::vector<double> limits = ParseSweepValues("--tolerance", tolerances);
  for (const double count : counts) {
    if (count != std::floor(count) || count < 1 || count > kMostIntervals) {
      Refuse("--intervals", intervals,
             FormatNumber(count, 12) + " must be a whole number in [1, " + std::to_string(kMostIntervals) + "]");
    }
  }
  for (const double limit : limits) {
    if (limit < kLeastTolerance || limit > kMostTolerance) {
      Refuse("--tolerance", tolerances, FormatNumber(limit, 12) + " must be in [1e-12, 1e-2]");
    }
  }
  const size_t size = words.size() * counts.size() * limits.size();
  if (size > kMostTradeoffPoints) {
    throw Failure(ExitCode::kUsage, "--scheme, --intervals and --tolerance make " + std::to_string(size) +
                                        " points, the most are " + std::to_string(kMostTradeoffPoints));
  }
  std::vector<TradeoffPoint> points;
  for (const std::string& word : words) {
    for (const double count : counts) {
      for (const double limit : limits) points.push_back({word, static_cast<int>(count), limit});
    }
  }
  return points;
}

v1::SolveSpec SpecOfPoint(v1::SolveSpec task, const TradeoffPoint& point) {
  if (task.has_manoeuvre())
    throw Failure(ExitCode::kUsage, "tradeoff: manoeuvre must be unset, only gaits are compared");
  if (task.has_phases())
    throw Failure(ExitCode::kUsage, "tradeoff: phases must be unset, they have their own intervals");
  if (!task.warm_start().empty()) {
    throw Failure(ExitCode::kUsage, "tradeoff: warm_start must be empty, a start from a solution hides the time");
  }
  v1::Discretization& mesh = *task.mutable_discretization();
  mesh.set_scheme(SchemeWords().at(point.scheme));
  mesh.set_single_support_intervals(point.intervals);
  mesh.clear_double_support_intervals();
  v1::Accuracy& accuracy = *task.mutable_accuracy();
  accuracy.set_kkt_tolerance(point.tolerance);
  accuracy.set_max_refinements(0);
  accuracy.set_estimate_errors(false);
  accuracy.clear_max_error();
  return task;
}

int OrderOf(const std::string& scheme) {
  for (const SchemeOrder& row : kOrders) {
    if (row.scheme == SchemeWords().at(scheme)) return row.order;
  }
  throw Failure(ExitCode::kUsage, "--scheme " + scheme + ": tradeoff does not know its order");
}

}  // namespace rollgait::client
