// "Did you mean": the known word that a mistyped one is nearest to.
#ifndef ROLLGAIT_CLIENT_SUGGESTION_H_
#define ROLLGAIT_CLIENT_SUGGESTION_H_

#include <string>
#include <vector>

namespace rollgait::client {

// Least number of letters to insert, remove or replace, and of neighbours to swap, that makes one word of the other
// (optimal string alignment). Counts bytes.
int EditDistance(const std::string& a, const std::string& b);

// The first candidate that begins with the word, the word having 3 letters or more; else the one that fewest edits make
// of it, the first of equals; empty if that takes more than 2 edits or more than a third of the word's length (at least
// 1).
std::string Nearest(const std::string& word, const std::vector<std::string>& candidates);

// "; did you mean CANDIDATE?", or nothing.
std::string DidYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace rollgait::client

#endif  // ROLLGAIT_CLIENT_SUGGESTION_H_
