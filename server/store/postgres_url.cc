#include "server/store/postgres_url.h"

#include <libpq-fe.h>

#include <algorithm>

namespace rollgait::server {

bool IsPostgresUrl(const std::string& text) {
  return text.rfind("postgresql://", 0) == 0 || text.rfind("postgres://", 0) == 0;
}

std::string WithoutPassword(const std::string& url) {
  const size_t scheme = url.find("://");
  if (scheme == std::string::npos) return "(not a URL)";
  std::string text = url;
  const size_t start = scheme + 3;
  // The last @, also when somebody forgot to write one of the password as %40.
  const size_t colon = text.find(':', start), at = text.rfind('@');
  if (at != std::string::npos && colon < at) text.replace(colon + 1, at - colon - 1, "***");
  for (const char* name : {"password=", "sslpassword="}) {
    for (size_t found = text.find(name); found != std::string::npos; found = text.find(name, found + 1)) {
      const size_t value = found + std::string(name).size();
      text.replace(value, std::min(text.find('&', value), text.size()) - value, "***");
    }
  }
  return text;
}

Outcome<Done> CheckPostgresUrl(const std::string& url) {
  char* reason = nullptr;
  PQconninfoOption* options = PQconninfoParse(url.c_str(), &reason);
  if (options != nullptr) {
    PQconninfoFree(options);
    return Done{};
  }
  // libpq quotes what it could not read, which may be a part of a password.
  const bool may_quote = WithoutPassword(url) == url && url.find('@') == std::string::npos;
  const std::string why = may_quote && reason != nullptr ? std::string(": ") + reason : "";
  PQfreemem(reason);
  return Error{ErrorCode::kInvalidArgument, "is not a PostgreSQL URL" + why +
                                                "; write postgresql://USER@HOST[,HOST2]/DATABASE, with special "
                                                "characters of a password as %XX"};
}

}  // namespace rollgait::server
