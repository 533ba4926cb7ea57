#include "server/base/log_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

#include "server/base/utf8.h"

namespace rollgait::server {
namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

enum class Quotes { kEscaped, kLeft };

// The inside of a JSON string, or with its quotes and backslashes left, what a line for people may hold.
std::string Escaped(std::string_view text, Quotes quotes = Quotes::kEscaped) {
  std::string escaped;
  for (size_t i = 0; i < text.size();) {
    if (escaped.size() > kMaxLogValue) return escaped + "…";
    const size_t length = Utf8SequenceLength(text, i);
    const char c = text[i];
    if (length == 0) {
      escaped += kReplacement;
    } else if (length > 1) {
      escaped += text.substr(i, length);
    } else if ((c == '"' || c == '\\') && quotes == Quotes::kEscaped) {
      escaped += {'\\', c};
    } else if (c == '\n') {
      escaped += "\\n";
    } else if (c < ' ' || c == 0x7f) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
      escaped += code;
    } else {
      escaped += c;
    }
    i += std::max<size_t>(length, 1);
  }
  return escaped;
}

// Whether a value can stand in a line for people without quotes.
bool IsPlain(std::string_view value, std::string_view escaped) {
  return !value.empty() && value == escaped && value.find_first_of(" =") == std::string_view::npos;
}

std::string Number(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "\"NaN\"" : value > 0 ? "\"Infinity\"" : "\"-Infinity\"";
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

std::string Value(LogFormat format, const LogValue& value) {
  if (const auto* text = std::get_if<std::string_view>(&value)) {
    const std::string escaped = Escaped(*text);
    return format == LogFormat::kText && IsPlain(*text, escaped) ? escaped : "\"" + escaped + "\"";
  }
  if (const auto* integer = std::get_if<int64_t>(&value)) return std::to_string(*integer);
  if (const auto* real = std::get_if<double>(&value)) return Number(*real);
  return std::get<bool>(value) ? "true" : "false";
}

}  // namespace

bool LogLine::Begin(std::string_view name) {
  if (std::find(names_.begin(), names_.end(), name) != names_.end()) return false;
  names_.push_back(name);
  if (format_ == LogFormat::kJson) {
    text_ += text_.empty() ? "{\"" : ",\"";
    text_ += name;
    text_ += "\":";
  } else if (!text_.empty()) {
    text_ += ' ';
  }
  return true;
}

void LogLine::AddWord(std::string_view name, std::string_view word) {
  if (!Begin(name)) return;
  text_ += format_ == LogFormat::kJson ? "\"" + Escaped(word) + "\"" : Escaped(word, Quotes::kLeft);
}

void LogLine::Add(const LogField& field) {
  if (!Begin(field.name)) return;
  if (format_ == LogFormat::kText) text_ += std::string(field.name) + "=";
  text_ += Value(format_, field.value);
}

std::string LogLine::Take() && {
  if (format_ == LogFormat::kJson) text_ += "}";
  return std::move(text_);
}

}  // namespace rollgait::server
