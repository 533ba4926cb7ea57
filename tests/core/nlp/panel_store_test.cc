#include "core/nlp/panel_store.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/support/allocation_counter.h"

namespace rollgait {
namespace {

// Larger than a block, empty, one number, many small ones over several blocks.
std::vector<size_t> Sizes() {
  std::vector<size_t> sizes = {3'000'000, 0, 1};
  for (size_t k = 0; k < 200; ++k) sizes.push_back(5000 + 37 * k);
  return sizes;
}

// Every panel is filled with a number of its own once all have been taken.
std::vector<double*> TakeAndFill(const std::vector<size_t>& sizes, PanelStore* store) {
  std::vector<double*> panels;
  for (const size_t size : sizes) panels.push_back(store->Take(size));
  for (size_t k = 0; k < sizes.size(); ++k) std::fill_n(panels[k], sizes[k], static_cast<double>(k));
  return panels;
}

TEST(PanelStore, GivesWholeLinesToEachAlone) {
  const std::vector<size_t> sizes = Sizes();
  PanelStore store;
  const std::vector<double*> panels = TakeAndFill(sizes, &store);
  for (size_t k = 0; k < sizes.size(); ++k) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(panels[k]) % (kNumbersPerLine * sizeof(double)), 0u) << k;
    EXPECT_EQ(std::count(panels[k], panels[k] + sizes[k], static_cast<double>(k)), static_cast<long>(sizes[k])) << k;
  }
}

TEST(PanelStore, AllocatesOnlyForMoreThanEverBefore) {
  const std::vector<size_t> sizes = Sizes();
  PanelStore store;
  const std::vector<double*> first = TakeAndFill(sizes, &store);
  std::vector<double*> panels(sizes.size());
  const long before = Allocations();
  store.Reset();
  for (size_t k = 0; k < sizes.size(); ++k) panels[k] = store.Take(sizes[k]);
  EXPECT_EQ(Allocations(), before);
  EXPECT_EQ(panels, first);
}

}  // namespace
}  // namespace rollgait
