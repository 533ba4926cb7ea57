#include "core/nlp/front_plan.h"

#include <algorithm>
#include <map>

#include "core/base/check.h"

namespace rollgait {

FrontPlan::FrontPlan(int size, const SparsityPattern& pattern, const std::vector<int>& groups,
                     const OuterProducts& products)
    : front_of_(size), rank_(size) {
  ROLLGAIT_CHECK(static_cast<int>(groups.size()) == size);
  FindFronts(size, pattern, groups, products);
  FindUpdates();
  AssignEntries(pattern, products);
}

// Fronts with what they eliminate and the later unknowns that they meet directly, some of them more than once.
void FrontPlan::FindFronts(int size, const SparsityPattern& pattern, const std::vector<int>& groups,
                           const OuterProducts& products) {
  std::map<int, int> front_of_group;
  for (const int group : groups) front_of_group[group] = 0;
  int count = 0;
  for (auto& [group, front] : front_of_group) front = count++;
  fronts.resize(count);
  for (int i = 0; i < size; ++i) {
    front_of_[i] = front_of_group[groups[i]];
    fronts[front_of_[i]].own.push_back(i);
  }
  int rank = 0;
  for (const PlannedFront& front : fronts) {
    for (const int i : front.own) rank_[i] = rank++;
  }
  std::vector<int> met_by(size, -1);  // the front that has met the unknown last
  const auto meet = [&](int front, int unknown) {
    if (front_of_[unknown] <= front || met_by[unknown] == front) return;
    met_by[unknown] = front;
    fronts[front].update.push_back(unknown);
  };
  for (int e = 0; e < pattern.size(); ++e) {
    const int row = pattern.rows[e], column = pattern.columns[e];
    meet(front_of_[row], column);
    meet(front_of_[column], row);
  }
  for (int k = 0; k < products.terms(); ++k) {
    int first = count;
    for (int i = products.first[k]; i < products.first[k + 1]; ++i) {
      first = std::min(first, front_of_[products.unknowns[i]]);
    }
    if (first == count) continue;
    fronts[first].products.push_back({k, 0, 0});
    for (int i = products.first[k]; i < products.first[k + 1]; ++i) meet(first, products.unknowns[i]);
  }
}

// What a front changes: what it meets itself, and what the fronts before it leave to it.
void FrontPlan::FindUpdates() {
  const auto earlier = [this](int a, int b) { return rank_[a] < rank_[b]; };
  std::vector<int> found_by(front_of_.size(), -1), found;
  for (int f = 0; f < static_cast<int>(fronts.size()); ++f) {
    PlannedFront& front = fronts[f];
    found.clear();
    const auto find = [&](int i) {
      if (front_of_[i] <= f || found_by[i] == f) return;
      found_by[i] = f;
      found.push_back(i);
    };
    std::for_each(front.update.begin(), front.update.end(), find);
    for (const int child : front.children) {
      std::for_each(fronts[child].update.begin(), fronts[child].update.end(), find);
    }
    std::sort(found.begin(), found.end(), earlier);
    front.update.assign(found.begin(), found.end());
    most_rows = std::max(most_rows, static_cast<int>(front.own.size() + front.update.size()));
    if (front.update.empty()) continue;
    front.is_root = false;
    fronts[front_of_[front.update.front()]].children.push_back(f);
  }
}

void FrontPlan::AssignEntries(const SparsityPattern& pattern, const OuterProducts& products) {
  std::vector<std::vector<int>> entries(fronts.size());
  for (int e = 0; e < pattern.size(); ++e) {
    entries[std::min(front_of_[pattern.rows[e]], front_of_[pattern.columns[e]])].push_back(e);
  }
  product_rows.reserve(products.unknowns.size());
  product_values.reserve(products.unknowns.size());
  std::vector<int> row_in(front_of_.size(), -1);
  for (size_t f = 0; f < fronts.size(); ++f) {
    PlannedFront& front = fronts[f];
    const int own = static_cast<int>(front.own.size());
    int place = 0;
    for (const int i : front.own) row_in[i] = place++;
    for (const int i : front.update) row_in[i] = place++;
    for (const int e : entries[f]) {
      const auto [column, row] = std::minmax({row_in[pattern.rows[e]], row_in[pattern.columns[e]]});
      if (!front.runs.empty()) {
        PlannedFront::Run& last = front.runs.back();
        if (e == last.value + last.count && column == last.column && row == last.row + last.count && row != own) {
          ++last.count;
          continue;
        }
      }
      front.runs.push_back({e, 1, row, column});
    }
    front.runs.shrink_to_fit();
    AssignProducts(static_cast<int>(f), row_in, products);
    for (const int child : front.children) {
      for (const int i : fronts[child].update) fronts[child].parent_row.push_back(row_in[i]);
    }
  }
}

void FrontPlan::AssignProducts(int front, const std::vector<int>& row_in, const OuterProducts& products) {
  std::vector<std::pair<int, int>> sorted;  // row, index of the value
  for (PlannedFront::Product& product : fronts[front].products) {
    sorted.clear();
    for (int i = products.first[product.term]; i < products.first[product.term + 1]; ++i) {
      sorted.emplace_back(row_in[products.unknowns[i]], products.values[i]);
    }
    std::sort(sorted.begin(), sorted.end());
    product.first = static_cast<int>(product_rows.size());
    for (const auto& [row, value] : sorted) {
      product_rows.push_back(row);
      product_values.push_back(value);
    }
    product.end = static_cast<int>(product_rows.size());
  }
}

}  // namespace rollgait
