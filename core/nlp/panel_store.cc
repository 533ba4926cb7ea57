#include "core/nlp/panel_store.h"

#include <sys/mman.h>

#include <algorithm>
#include <new>

namespace rollgait {
namespace {

constexpr std::align_val_t kHugePage{size_t{2} << 20};
constexpr size_t kBlockEntries = 2 * static_cast<size_t>(kHugePage) / sizeof(double);

size_t RoundedUp(size_t count, size_t unit) { return (count + unit - 1) / unit * unit; }

}  // namespace

void PanelStore::Free::operator()(double* block) const { ::operator delete(block, kHugePage); }

void PanelStore::Reset() { current_ = used_ = 0; }

double* PanelStore::Take(size_t count) {
  count = RoundedUp(count, kNumbersPerLine);
  while (current_ < blocks_.size() && used_ + count > blocks_[current_].size) {
    ++current_;
    used_ = 0;
  }
  if (current_ == blocks_.size()) {
    const size_t size = RoundedUp(std::max(count, kBlockEntries), kBlockEntries), bytes = size * sizeof(double);
    auto* data = static_cast<double*>(::operator new(bytes, kHugePage));
    blocks_.push_back({std::unique_ptr<double[], Free>(data), size});
    madvise(data, bytes, MADV_HUGEPAGE);  // an advice: small pages do, too
  }
  double* taken = blocks_[current_].data.get() + used_;
  used_ += count;
  return taken;
}

}  // namespace rollgait
