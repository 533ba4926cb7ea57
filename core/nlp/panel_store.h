#ifndef ROLLGAIT_CORE_NLP_PANEL_STORE_H_
#define ROLLGAIT_CORE_NLP_PANEL_STORE_H_

#include <cstddef>
#include <memory>
#include <vector>

namespace rollgait {

// Numbers in 64 bytes, a line of the cache.
inline constexpr int kNumbersPerLine = 8;

// Memory for the panels of one factorisation after the other. They lie side by side in a few blocks of huge pages,
// where the system has them: a solve visits all panels several times an iteration. What has been allocated stays.
class PanelStore {
 public:
  // Everything taken before may be taken again.
  void Reset();
  // `count` numbers, not cleared, from the start of a line on; they stay where they are until the next Reset.
  double* Take(size_t count);

 private:
  struct Free {
    void operator()(double* block) const;
  };
  struct Block {
    std::unique_ptr<double[], Free> data;
    size_t size;
  };

  std::vector<Block> blocks_;
  size_t current_ = 0, used_ = 0;  // block in use, and how many of its numbers are taken
};

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_NLP_PANEL_STORE_H_
