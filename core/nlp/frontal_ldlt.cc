#include "core/nlp/frontal_ldlt.h"

#include <algorithm>

#include "core/math/subtract_products.h"
#include "core/nlp/front_pivoting.h"

namespace rollgait {
namespace {

// Columns of L that a solution takes together.
constexpr int kColumnsAtOnce = 8;

// Columns that a front takes up from the fronts before it, at most: so many times as many as the widest front has by
// the plan, which then takes some twenty times its memory. Where rows depend on each other in every stage, each front
// leaves some pivots over: those of a planar gait on a fine mesh grew by six a stage, until the last fronts had 24 GB.
// Of narrow plans (tests, small problems) kLeastMostDelayed is allowed, which takes half a megabyte.
constexpr int kMostDelayed = 4, kLeastMostDelayed = 256;

int WholeLines(int numbers) { return (numbers + kNumbersPerLine - 1) / kNumbersPerLine * kNumbersPerLine; }

void AddTo(double* __restrict sum, const double* __restrict term, int n) {
  for (int i = 0; i < n; ++i) sum[i] += term[i];
}

// Of column j the rows from j to `rows`.
void ClearLowerTriangle(double* a, int stride, int columns, int rows) {
  for (int j = 0; j < columns; ++j) {
    double* column = a + static_cast<size_t>(j) * stride;
    std::fill(column + j, column + rows, 0.0);
  }
}

// The upper triangle of the first `columns` rows becomes the lower one's transpose.
void MirrorLowerTriangle(double* a, int stride, int columns) {
  // Both sides of a block stay in the first cache.
  constexpr int kColumnsInCache = 16;
  for (int first = 0; first < columns; first += kColumnsInCache) {
    const int end = std::min(first + kColumnsInCache, columns);
    for (int i = first; i < columns; ++i) {
      double* row = a + static_cast<size_t>(i) * stride;
      for (int j = first; j < std::min(end, i); ++j) row[j] = a[static_cast<size_t>(j) * stride + i];
    }
  }
}

}  // namespace

FrontalLdlt::FrontalLdlt(int size, const SparsityPattern& pattern, const std::vector<int>& groups,
                         const OuterProducts& products)
    : gathered_(size + kNumbersPerLine) {  // the rows of a front, with zeros up to the next line
  FrontPlan plan(size, pattern, groups, products);
  product_rows_ = std::move(plan.product_rows);
  product_values_ = std::move(plan.product_values);
  fronts_.reserve(plan.fronts.size());
  for (PlannedFront& front : plan.fronts) fronts_.emplace_back(std::move(front));
  most_delayed_ = std::max(kLeastMostDelayed, kMostDelayed * plan.most_rows);
  map_.reserve(plan.most_rows);
  run_ends_.reserve(plan.most_rows);
  AssignBlocks();
}

// A chain needs a handful of Schur complements at once, and its fronts find them in the cache.
void FrontalLdlt::AssignBlocks() {
  std::vector<int> free;
  for (Front& front : fronts_) {
    if (free.empty()) {
      free.push_back(static_cast<int>(blocks_.size()));
      blocks_.emplace_back();
    }
    front.block = free.back();
    free.pop_back();
    const size_t size = front.update.size() * front.update.size();
    if (blocks_[front.block].size() < size) blocks_[front.block].resize(size);
    for (int child : front.children) free.push_back(fronts_[child].block);
    if (front.is_root) free.push_back(front.block);
  }
}

FrontalLdlt::Inertia FrontalLdlt::Factorise(const double* values, double threshold,
                                            const OuterProductValues& products) {
  inertia_ = {};
  factor_entries_ = 0;
  delayed_pivots_ = 0;
  panels_.Reset();
  for (Front& front : fronts_) {
    int taken_up = 0;
    for (int c : front.children) taken_up += fronts_[c].columns - fronts_[c].pivots;
    if (taken_up > most_delayed_) {
      inertia_.zero += taken_up;
      return inertia_;
    }
    Assemble(values, products, &front);
    FactorPanel(&front, threshold);
    UpdateSchur(&front);
    factor_entries_ += static_cast<long>(front.pivots) * (front.columns + static_cast<long>(front.update.size()));
    const int left = front.columns - front.pivots;
    (front.is_root ? inertia_.zero : delayed_pivots_) += left;
  }
  return inertia_;
}

// The fully summed block is put together in its lower triangle and then kept in full; the rest of the panel has the
// rows of `update`.
void FrontalLdlt::Assemble(const double* values, const OuterProductValues& products, Front* front) {
  const int own = static_cast<int>(front->own.size());
  front->unknowns = front->own;
  for (int c : front->children) {
    const Front& child = fronts_[c];
    front->unknowns.insert(front->unknowns.end(), child.unknowns.begin() + child.pivots,
                           child.unknowns.begin() + child.columns);
  }
  front->columns = static_cast<int>(front->unknowns.size());
  const int order = static_cast<int>(front->update.size());
  front->first_update = WholeLines(front->columns);
  front->rows = front->first_update + order;
  front->stride = WholeLines(front->rows);
  front->panel = panels_.Take(static_cast<size_t>(front->stride) * front->columns);
  ClearLowerTriangle(front->panel, front->stride, front->columns, front->rows);
  if (front->children.empty()) ClearLowerTriangle(Schur(*front), order, order, order);
  const int shift = front->first_update - own;
  for (const PlannedFront::Run& run : front->runs) {
    const int row = run.row < own ? run.row : run.row + shift;
    AddTo(front->Column(run.column) + row, values + run.value, run.count);
  }
  int slot = own;
  for (int c : front->children) {
    AddChild(fronts_[c], slot, front);
    slot += fronts_[c].columns - fronts_[c].pivots;
  }
  AddProducts(products, front);
  MirrorLowerTriangle(front->panel, front->stride, front->columns);
}

// A term may meet later unknowns alone in part, so it goes to the Schur complement, too.
void FrontalLdlt::AddProducts(const OuterProductValues& products, Front* front) {
  const int own = static_cast<int>(front->own.size()), order = static_cast<int>(front->update.size());
  const int shift = front->first_update - own;
  for (const PlannedFront::Product& product : front->products) {
    const double weight = products.weights[product.term];
    int i = product.first;
    for (; i < product.end && product_rows_[i] < own; ++i) {
      const double scaled = weight * products.vectors[product_values_[i]];
      double* target = front->Column(product_rows_[i]);
      for (int j = i; j < product.end; ++j) {
        const int row = product_rows_[j];
        target[row < own ? row : row + shift] += scaled * products.vectors[product_values_[j]];
      }
    }
    for (; i < product.end; ++i) {
      const double scaled = weight * products.vectors[product_values_[i]];
      double* target = Schur(*front) + static_cast<size_t>(product_rows_[i] - own) * order - own;
      for (int j = i; j < product.end; ++j) target[product_rows_[j]] += scaled * products.vectors[product_values_[j]];
    }
  }
}

// What the child has left over goes to the columns from first_slot on, its Schur complement to the rows of its
// `update`.
void FrontalLdlt::AddChild(const Front& child, int first_slot, Front* front) {
  const int own = static_cast<int>(front->own.size());
  const int shift = front->first_update - own;
  const int delayed = child.columns - child.pivots;
  const int update = static_cast<int>(child.update.size());
  // The map is ascending, so a lower triangle stays one; rows that stay neighbours are added in one go.
  map_.clear();
  for (int row : child.parent_row) map_.push_back(row < own ? row : row + shift);
  run_ends_.assign(update, update);
  for (int i = update - 2; i >= 0; --i) run_ends_[i] = map_[i] + 1 == map_[i + 1] ? run_ends_[i + 1] : i + 1;
  for (int j = 0; j < delayed; ++j) {
    const double* column = child.Column(child.pivots + j);
    const int slot = first_slot + j;
    for (int i = j; i < delayed; ++i) front->Column(slot)[first_slot + i] += column[child.pivots + i];
    for (int i = 0; i < update; ++i)
      front->Column(std::min(map_[i], slot))[std::max(map_[i], slot)] += column[child.first_update + i];
  }
  int summed = 0;  // rows of the child's update that this front eliminates
  for (; summed < update && map_[summed] < front->columns; ++summed) {
    AddRuns(Schur(child) + static_cast<size_t>(summed) * update, summed, update, front->Column(map_[summed]));
  }
  if (&child == &fronts_[front->children.front()]) {
    CopySchur(child, summed, front);
    return;
  }
  const int order = static_cast<int>(front->update.size());
  for (int j = summed; j < update; ++j) {
    AddRuns(Schur(child) + static_cast<size_t>(j) * update, j, update,
            Schur(*front) + static_cast<size_t>(map_[j] - front->first_update) * order - front->first_update);
  }
}

// target[map_[i]] += column[i] from i = first on.
void FrontalLdlt::AddRuns(const double* column, int first, int end, double* target) const {
  for (int i = first; i < end; i = run_ends_[i]) AddTo(target + map_[i], column + i, run_ends_[i] - i);
}

// The first child's part of the Schur complement, from its row `first` on, and zeros elsewhere: what is written once
// need not be cleared before.
void FrontalLdlt::CopySchur(const Front& child, int first, Front* front) {
  const int update = static_cast<int>(child.update.size()), order = static_cast<int>(front->update.size());
  int done = 0;
  const auto clear_until = [&](int column) {
    ClearLowerTriangle(Schur(*front) + static_cast<size_t>(done) * order + done, order, column - done, order - done);
    done = column + 1;
  };
  for (int j = first; j < update; ++j) {
    const double* column = Schur(child) + static_cast<size_t>(j) * update;
    const int place = map_[j] - front->first_update;
    clear_until(place);
    double* target = Schur(*front) + static_cast<size_t>(place) * order;
    int row = place;
    for (int i = j; i < update; i = run_ends_[i]) {
      const int start = map_[i] - front->first_update;
      std::fill(target + row, target + start, 0.0);
      std::copy(column + i, column + run_ends_[i], target + start);
      row = start + run_ends_[i] - i;
    }
    std::fill(target + row, target + order, 0.0);
  }
  clear_until(order);
}

void FrontalLdlt::FactorPanel(Front* front, double threshold) {
  front->diagonal.assign(front->columns, 0.0);
  front->coupling.assign(front->columns, 0.0);
  const size_t size = static_cast<size_t>(front->stride) * front->columns;
  if (scaled_.size() < size) scaled_.resize(size);
  if (updated_.size() < static_cast<size_t>(front->columns)) updated_.resize(front->columns);
  FrontPanel panel{front->rows,    front->columns,         front->stride,          front->panel,
                   scaled_.data(), front->diagonal.data(), front->coupling.data(), front->unknowns.data(),
                   updated_.data()};
  const FrontPivots found = EliminateFront(panel, threshold);
  front->pivots = found.count;
  inertia_.negative += found.negative;
  inertia_.positive += found.count - found.negative;
}

void FrontalLdlt::UpdateSchur(Front* front) {
  const int order = static_cast<int>(front->update.size());
  SubtractProductTriangle(front->panel + front->first_update, front->stride, scaled_.data() + front->first_update,
                          front->stride, front->pivots, order, Schur(*front), order);
}

void FrontalLdlt::Solve(double* x) {
  double* y = gathered_.data();
  for (const Front& front : fronts_) {
    const int pivots = front.pivots, rows = front.rows;
    for (int i = 0; i < pivots; ++i) y[i] = x[front.unknowns[i]];
    std::fill(y + pivots, y + rows, 0.0);
    for (int first = 0, end; first < pivots; first = end) {
      end = std::min(first + kColumnsAtOnce, pivots);
      const double* columns = front.Column(first);
      for (int k = first; k < end; ++k) {
        const double* column = front.Column(k);
        for (int i = k + 1; i < end; ++i) y[i] -= column[i] * y[k];
      }
      SubtractProducts(columns + end, front.stride, y + first, 1, end - first, rows - end, y + end);
    }
    for (int i = pivots; i < front.columns; ++i) x[front.unknowns[i]] += y[i];
    for (int i = front.first_update; i < rows; ++i) x[front.update[i - front.first_update]] += y[i];
    for (int k = 0; k < pivots; ++k) {
      double* value = y + k;
      if (front.coupling[k] != 0) {
        const double a = front.diagonal[k], b = front.coupling[k], c = front.diagonal[k + 1];
        // Divided by b first: the product a c may overflow where the quotients do not.
        const double d = (a / b) * (c / b) - 1;
        const double first = (c / b * value[0] - value[1]) / (b * d);
        value[1] = (a / b * value[1] - value[0]) / (b * d);
        value[0] = first;
        ++k;
      } else {
        value[0] /= front.diagonal[k];
      }
    }
    for (int k = 0; k < pivots; ++k) x[front.unknowns[k]] = y[k];
  }
  for (auto front = fronts_.rbegin(); front != fronts_.rend(); ++front) {
    const int pivots = front->pivots, rows = front->rows;
    for (int i = 0; i < front->columns; ++i) y[i] = x[front->unknowns[i]];
    std::fill(y + front->columns, y + front->first_update, 0.0);
    for (int i = front->first_update; i < rows; ++i) y[i] = x[front->update[i - front->first_update]];
    for (int end = pivots, first; end > 0; end = first) {
      first = (end - 1) / kColumnsAtOnce * kColumnsAtOnce;
      const double* columns = front->Column(first);
      SubtractTransposedProduct(columns + end, front->stride, end - first, rows - end, y + end, y + first);
      for (int k = end - 1; k >= first; --k) {
        const double* column = front->Column(k);
        for (int i = k + 1; i < end; ++i) y[k] -= column[i] * y[i];
      }
    }
    for (int k = 0; k < pivots; ++k) x[front->unknowns[k]] = y[k];
  }
}

}  // namespace rollgait
