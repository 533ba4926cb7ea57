#include "client/import/xml_source.h"

#include <tinyxml2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <sstream>

#include "client/failure.h"
#include "client/formats/exact_number.h"
#include "client/text.h"

namespace rollgait::client {
namespace {

constexpr size_t kMostRows = 60;

bool IsShown(const char* text) { return text != nullptr && std::strlen(text) <= kMaxXmlName && IsUtf8(text); }
std::string KindOf(const tinyxml2::XMLElement& element) {
  const std::string kind = std::string(element.Name()).substr(0, 64);
  return IsUtf8(kind) ? kind : "?";
}

}  // namespace

std::string XmlSource::Where(const tinyxml2::XMLElement& element) const {
  const char* const name = element.Attribute("name");
  std::string where = path_ + ":" + std::to_string(element.GetLineNum()) + ": <" + KindOf(element);
  if (IsShown(name)) where += " name=\"" + std::string(name) + "\"";
  const tinyxml2::XMLElement* owner = &element;
  while (owner->Attribute("name") == nullptr && owner->Parent() != nullptr && owner->Parent()->ToElement() != nullptr) {
    owner = owner->Parent()->ToElement();
  }
  const char* const owner_name = owner->Attribute("name");
  if (owner != &element && IsShown(owner_name)) {
    where += "> of <" + KindOf(*owner) + " name=\"" + owner_name + "\"";
  }
  return WithoutControls(where + ">");
}

void XmlSource::Refuse(const tinyxml2::XMLElement& element, const std::string& reason) const {
  throw Failure(ExitCode::kUsage, Where(element) + ": " + WithoutControls(reason));
}

std::string XmlSource::Text(const tinyxml2::XMLElement& element, const char* attribute) const {
  const char* const text = element.Attribute(attribute);
  if (text == nullptr || *text == '\0') Refuse(element, std::string("needs the attribute ") + attribute);
  return text;
}

void XmlSource::RequireName(const tinyxml2::XMLElement& element, const std::string& what,
                            const std::string& name) const {
  if (name.size() > kMaxXmlName) {
    Refuse(element, what + " has " + std::to_string(name.size()) + " bytes; at most " + std::to_string(kMaxXmlName) +
                        " are accepted");
  }
  if (!IsUtf8(name)) Refuse(element, what + " is no UTF-8");
  if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    Refuse(element, what + " holds a control character");
  }
}

std::string XmlSource::Name(const tinyxml2::XMLElement& element, const char* attribute) const {
  std::string name = Text(element, attribute);
  RequireName(element, attribute, name);
  return name;
}

XmlNumbers XmlSource::Numbers(const tinyxml2::XMLElement& element, const std::string& what, const char* text,
                              size_t least, size_t most) const {
  std::istringstream words(text == nullptr ? "" : text);
  std::string word;
  XmlNumbers numbers;
  size_t found = 0;
  for (; words >> word; ++found) {
    const char* const first = word.data() + (word[0] == '+' ? 1 : 0);
    const char* const last = word.data() + word.size();
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    const std::string shown = word.substr(0, 40);
    if (error == std::errc::invalid_argument || end != last) {
      Refuse(element, what + " has \"" + shown + "\", which is no number");
    }
    if (error != std::errc() || !std::isfinite(value) || std::abs(value) > kMaxXmlNumber) {
      Refuse(element, what + " has " + shown + "; numbers must be finite and within ±" + Exact(kMaxXmlNumber));
    }
    if (found >= most) continue;
    numbers.values.push_back(value);
    numbers.text += (numbers.text.empty() ? "" : " ") + word;
  }
  if (found < least || found > most) {
    Refuse(element, what + " has " + std::to_string(found) + " numbers, must have " + std::to_string(least) +
                        (least == most ? "" : " to " + std::to_string(most)));
  }
  return numbers;
}

double XmlSource::Number(const tinyxml2::XMLElement& element, const std::string& what, const char* text) const {
  return Numbers(element, what, text, 1, 1).values[0];
}

Eigen::Vector3d XmlSource::Vector(const tinyxml2::XMLElement& element, const std::string& what,
                                  const char* text) const {
  const std::vector<double> values = Numbers(element, what, text, 3, 3).values;
  return {values[0], values[1], values[2]};
}

bool XmlSource::Flag(const tinyxml2::XMLElement& element, const std::string& what, const char* text) const {
  std::string word;
  std::istringstream(text == nullptr ? "" : text) >> word;
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  if (word != "true" && word != "false") {
    Refuse(element, what + " is \"" + word.substr(0, 40) + "\"; must be true or false");
  }
  return word == "true";
}

const tinyxml2::XMLElement* XmlSource::Only(const tinyxml2::XMLElement& element, const char* child,
                                            bool required) const {
  const tinyxml2::XMLElement* const found = element.FirstChildElement(child);
  if (found == nullptr && required) Refuse(element, std::string("needs an element <") + child + ">");
  if (found != nullptr && found->NextSiblingElement(child) != nullptr) {
    Refuse(*found->NextSiblingElement(child), "stands twice");
  }
  return found;
}

void LeftOut::Add(const tinyxml2::XMLElement& element, const std::string& reason) {
  const std::string kind = KindOf(element);
  const auto row =
      std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.kind == kind && r.reason == reason; });
  if (row != rows_.end()) {
    ++row->count;
  } else if (rows_.size() < kMostRows) {
    rows_.push_back({kind, source_->Where(element), reason, 1});
  } else {
    ++further_;
  }
}

std::vector<std::string> LeftOut::Lines() const {
  std::vector<std::string> lines;
  for (const Row& row : rows_) {
    const std::string more = row.count > 1 ? " and " + std::to_string(row.count - 1) + " more" : "";
    lines.push_back(row.where + more + ": " + row.reason);
  }
  if (further_ > 0) lines.push_back(source_->path() + ": " + std::to_string(further_) + " elements of other kinds");
  return lines;
}

}  // namespace rollgait::client
