#include "client/import/mirror_names.h"

#include <cctype>
#include <utility>

namespace rollgait::client {
namespace {

bool IsSeparator(char c) { return c == '_' || c == '-' || c == '.' || c == ' '; }
bool IsLower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool IsUpper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

std::string ReplaceAll(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// 'l', 'L', 'r' and 'R' exchanged; 0 for another letter.
char OtherLetter(char c) { return c == 'l' ? 'r' : c == 'r' ? 'l' : c == 'L' ? 'R' : c == 'R' ? 'L' : '\0'; }
v1::BodySide SideOfLetter(char c) { return c == 'l' || c == 'L' ? v1::BODY_SIDE_LEFT : v1::BODY_SIDE_RIGHT; }

MirrorName WithOtherLetter(const std::string& name, size_t at) {
  MirrorName mirror{SideOfLetter(name[at]), name};
  mirror.other[at] = OtherLetter(name[at]);
  return mirror;
}

}  // namespace

MirrorName MirrorNameOf(const std::string& name) {
  constexpr std::pair<const char*, const char*> kWords[] = {{"left", "right"}, {"Left", "Right"}, {"LEFT", "RIGHT"}};
  for (const auto& [left, right] : kWords) {
    if (name.find(left) != std::string::npos) return {v1::BODY_SIDE_LEFT, ReplaceAll(name, left, right)};
    if (name.find(right) != std::string::npos) return {v1::BODY_SIDE_RIGHT, ReplaceAll(name, right, left)};
  }
  for (size_t i = 0; i < name.size(); ++i) {
    const bool begins = i == 0 || IsSeparator(name[i - 1]), ends = i + 1 == name.size() || IsSeparator(name[i + 1]);
    if (begins && ends && OtherLetter(name[i]) != '\0') return WithOtherLetter(name, i);
  }
  if (name.size() >= 3 && OtherLetter(name[0]) != '\0' && IsUpper(name[1]) && IsLower(name[2])) {
    return WithOtherLetter(name, 0);
  }
  const size_t last = name.size() - 1;
  if (name.size() >= 2 && (name[last] == 'L' || name[last] == 'R') && IsLower(name[last - 1])) {
    return WithOtherLetter(name, last);
  }
  return {v1::BODY_SIDE_UNSPECIFIED, name};
}

}  // namespace rollgait::client
