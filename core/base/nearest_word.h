#ifndef ROLLGAIT_CORE_BASE_NEAREST_WORD_H_
#define ROLLGAIT_CORE_BASE_NEAREST_WORD_H_

#include <algorithm>
#include <string>
#include <vector>

namespace rollgait {

// Least number of letters to insert, remove or replace, and of neighbours to swap, that makes one word of the other
// (optimal string alignment). Counts bytes.
inline int EditDistance(const std::string& a, const std::string& b) {
  // rows[k]: distances of the first (row - k) letters of a to the beginnings of b.
  std::vector<std::vector<int>> rows(3, std::vector<int>(b.size() + 1));
  for (size_t j = 0; j <= b.size(); ++j) rows[0][j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    std::rotate(rows.begin(), rows.begin() + 2, rows.end());
    rows[0][0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      rows[0][j] = std::min({rows[1][j] + 1, rows[0][j - 1] + 1, rows[1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) rows[0][j] = std::min(rows[0][j], rows[2][j - 2] + 1);
    }
  }
  return rows[0][b.size()];
}

// The first candidate that begins with the word, the word having 3 letters or more; else the one that fewest edits make
// of it, the first of equals; empty if that takes more than 2 edits or more than a third of the word's length (at least
// 1).
inline std::string Nearest(const std::string& word, const std::vector<std::string>& candidates) {
  const size_t letters = word.size() - std::min(word.size(), word.find_first_not_of('-'));
  for (const std::string& candidate : candidates) {
    if (letters >= 3 && candidate.rfind(word, 0) == 0) return candidate;
  }
  std::string nearest;
  int least = std::clamp(static_cast<int>(word.size()) / 3, 1, 2) + 1;
  for (const std::string& candidate : candidates) {
    const int distance = EditDistance(word, candidate);
    if (distance < least) least = distance, nearest = candidate;
  }
  return nearest;
}

// "; did you mean CANDIDATE?", or nothing.
inline std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string nearest = Nearest(word, candidates);
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

}  // namespace rollgait

#endif  // ROLLGAIT_CORE_BASE_NEAREST_WORD_H_
