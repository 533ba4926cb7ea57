#ifndef ROLLGAIT_CORE_OCP_COST_TRAITS_H_
#define ROLLGAIT_CORE_OCP_COST_TRAITS_H_

#include <map>
#include <optional>
#include <string>
#include <type_traits>

namespace rollgait {

// Weights by joint name, as a request gives them.
using JointWeights = std::map<std::string, double>;

// Which joints the joint_weights of a term may name. Those that are not named have weight 1 where they are actuated,
// else 0.
enum class WeightedJoints { kActuated, kAll };

// What is known of a kind of cost term without an instance. The integrand has the dimension M^mass_power T^time_power
// in mass and time; requests are solved in units of their own (core/gait/own_units.h), in which lengths stay metres.
struct CostTraits {
  const char* field;  // of the oneof rollgait.v1.CostTerm.term; its option cost_word is its word on the command line
  const char* name;   // in results
  const char* unit;   // of the integral
  int mass_power = 0, time_power = 0;
  WeightedJoints weighted = WeightedJoints::kActuated;  // of a term that has joint_weights
  bool is_rate = false;  // of efforts or forces: short intervals tell how fast they change
};

// A number of a kind of term that a request may leave unset.
template <typename Term>
struct CostParameter {
  std::optional<double> Term::*member = nullptr;
  const char* field = "";  // of the term's message
  double fallback = 0;     // where it is unset; of a smoothing for 75 kg and 9.81 m/s²
  double min = 0, max = 0;
  const char* unit = "";
  // It makes the corner of a power round (costs/power_price.h): its default follows mass and gravity as powers do, and
  // a cold start begins with a larger one.
  bool is_smoothing = false;
};

// The row of a kind of term. Term has the members that its parameters name, and what else a request says of it: members
// `joint_weights` (JointWeights) and `channels` (cost::Tracking) are known by their name.
template <typename T>
struct CostRow {
  using Term = T;
  static constexpr int kMostParameters = 3;
  CostTraits traits;
  CostParameter<T> parameters[kMostParameters] = {};

  template <typename Visit>
  void ForEachParameter(Visit visit) const {
    if constexpr (!std::is_empty_v<T>) {
      for (const CostParameter<T>& parameter : parameters) {
        if (parameter.member != nullptr) visit(parameter);
      }
    }
  }
};

template <typename Term>
concept HasJointWeights = requires(Term term) {
  term.joint_weights;
};

template <typename Term>
concept HasChannels = requires(Term term) {
  term.channels;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_OCP_COST_TRAITS_H_
