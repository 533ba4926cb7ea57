#ifndef ROLLGAIT_CORE_NLP_OUTER_PRODUCTS_H_
#define ROLLGAIT_CORE_NLP_OUTER_PRODUCTS_H_

#include <vector>

namespace rollgait {

// Where the terms  Σ_k w_k a_k a_kᵀ  of a symmetric matrix are: few numbers of each a_k differ from 0, and an unknown
// occurs once in it.
struct OuterProducts {
  // Of term k the entries first[k] … first[k + 1] − 1; of an entry its unknown and the index of its value.
  std::vector<int> first{0}, unknowns, values;

  int terms() const { return static_cast<int>(first.size()) - 1; }
  void Add(int unknown, int value) {
    unknowns.push_back(unknown);
    values.push_back(value);
  }
  void EndTerm() { first.push_back(static_cast<int>(unknowns.size())); }
};

// Their numbers: those of the vectors a_k, by OuterProducts::values, and the weights w_k.
struct OuterProductValues {
  const double* vectors = nullptr;
  const double* weights = nullptr;
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_OUTER_PRODUCTS_H_
