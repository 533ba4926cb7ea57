#include "server/gateway/json.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/util/json_util.h>
#include <google/protobuf/util/type_resolver_util.h>

#include <memory>

#include "server/base/utf8.h"

namespace rollgait::server {
namespace {

namespace util = google::protobuf::util;

constexpr char kUrl[] = "type.googleapis.com";
constexpr size_t kMostText = 1000;

util::TypeResolver& Resolver() {
  static util::TypeResolver* const resolver =
      util::NewTypeResolverForDescriptorPool(kUrl, google::protobuf::DescriptorPool::generated_pool());
  return *resolver;
}

std::string Url(const google::protobuf::Descriptor& type) { return std::string(kUrl) + "/" + type.full_name(); }

}  // namespace

std::string JsonToWire(std::string_view json, const google::protobuf::Descriptor& type, std::string* wire) {
  wire->clear();
  const auto status = util::JsonToBinaryString(
      &Resolver(), Url(type), google::protobuf::StringPiece(json.data(), json.size()), wire, util::JsonParseOptions());
  if (status.ok()) return "";
  const std::string reason = PlainText(status.message().ToString());
  return reason.empty() ? "no reason is known" : reason;
}

bool WireToJson(const std::string& wire, const google::protobuf::Descriptor& type, std::string* json) {
  json->clear();
  return util::BinaryToJsonString(&Resolver(), Url(type), wire, json, util::JsonPrintOptions()).ok();
}

std::string WireField(int number, const std::string& wire) {
  std::string field;
  {
    google::protobuf::io::StringOutputStream stream(&field);
    google::protobuf::io::CodedOutputStream output(&stream);
    output.WriteVarint32(static_cast<uint32_t>(number) << 3 | 2);
    output.WriteVarint32(static_cast<uint32_t>(wire.size()));
    output.WriteString(wire);
  }
  return field;
}

std::string JsonString(const std::string& text) {
  std::string quoted = "\"";
  for (const char byte : text) {
    if (byte == '"' || byte == '\\') {
      quoted += '\\';
      quoted += byte;
    } else if (static_cast<unsigned char>(byte) < ' ') {
      constexpr char kDigits[] = "0123456789abcdef";
      quoted += "\\u00";
      quoted += kDigits[byte >> 4];
      quoted += kDigits[byte & 15];
    } else {
      quoted += byte;
    }
  }
  return quoted + "\"";
}

std::string PlainText(const std::string& text) {
  std::string clean;
  for (size_t i = 0; i < text.size();) {
    const size_t length = Utf8SequenceLength(text, i);
    if (clean.size() + length > kMostText) return clean + "…";
    const bool printable = length > 1 || (length == 1 && static_cast<unsigned char>(text[i]) >= ' ' && text[i] != 0x7f);
    // A line feed of the parser's message stands before the place it means.
    clean += printable ? text.substr(i, length) : text[i] == '\n' ? " " : "?";
    i += length == 0 ? 1 : length;
  }
  while (!clean.empty() && (clean.back() == ' ' || clean.back() == '^')) clean.pop_back();
  return clean;
}

}  // namespace rollgait::server
