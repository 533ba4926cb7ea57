#ifndef ROLLGAIT_CORE_NLP_FRONT_PLAN_H_
#define ROLLGAIT_CORE_NLP_FRONT_PLAN_H_

#include <vector>

#include "core/nlp/outer_products.h"
#include "core/nlp/problem.h"

namespace rollgait {

// What a front eliminates and what it is put together from, as far as patterns decide it. Its rows: first those of
// `own`, then those of `update`.
struct PlannedFront {
  // Entries of the matrix with neighbouring values that are neighbours in a column: values `value` … `value` + count −
  // 1 go to the rows from `row` on. row >= column; all rows are of `own`, or all of `update`.
  struct Run {
    int value, count, row, column;
  };
  // A term of the outer products whose first unknown is of `own`: its entries from `first` to `end` − 1 in
  // FrontPlan::product_rows.
  struct Product {
    int term, first, end;
  };

  std::vector<int> own;     // unknowns that it eliminates
  std::vector<int> update;  // unknowns of later fronts that it changes, in the order of elimination
  std::vector<int> children;
  std::vector<int> parent_row;  // row of update[i] in the parent
  std::vector<Run> runs;
  std::vector<Product> products;
  bool is_root = true;
};

// The tree of fronts of FrontalLdlt, in the order of elimination.
struct FrontPlan {
  // `pattern`: entries of one triangle (either, duplicates add) of a matrix of order `size`; `groups` (size): smaller
  // is eliminated earlier. Contract: rows and columns within size; groups >= 0.
  FrontPlan(int size, const SparsityPattern& pattern, const std::vector<int>& groups, const OuterProducts& products);

  std::vector<PlannedFront> fronts;
  int most_rows = 0;  // of a front
  // Entries of the outer products, term by term in the order of elimination: row in the front of their term, index of
  // the value.
  std::vector<int> product_rows, product_values;

 private:
  void FindFronts(int size, const SparsityPattern& pattern, const std::vector<int>& groups,
                  const OuterProducts& products);
  void FindUpdates();
  void AssignEntries(const SparsityPattern& pattern, const OuterProducts& products);
  void AssignProducts(int front, const std::vector<int>& row_in, const OuterProducts& products);

  std::vector<int> front_of_, rank_;  // of an unknown: its front; its place in the order of elimination
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_FRONT_PLAN_H_
