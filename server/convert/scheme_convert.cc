#include "server/convert/scheme_convert.h"

#include <cctype>
#include <string>

#include "core/base/check.h"

namespace rollgait {
namespace {

// "hermite-simpson" is SCHEME_HERMITE_SIMPSON.
std::string NameOf(const SchemeTraits& traits) {
  std::string name = "SCHEME_";
  for (const char* c = traits.word; *c != '\0'; ++c) {
    name += *c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(*c)));
  }
  return name;
}

}  // namespace

v1::Discretization::Scheme EncodeScheme(Scheme scheme) {
  v1::Discretization::Scheme encoded = v1::Discretization::SCHEME_UNSPECIFIED;
  ROLLGAIT_CHECK(v1::Discretization::Scheme_Parse(NameOf(TraitsOf(scheme)), &encoded));
  return encoded;
}

std::optional<Scheme> DecodeScheme(v1::Discretization::Scheme scheme) {
  for (const SchemeTraits& traits : Schemes()) {
    if (v1::Discretization::Scheme_Name(scheme) == NameOf(traits)) return traits.scheme;
  }
  return std::nullopt;
}

}  // namespace rollgait
