#ifndef ROLLGAIT_SERVER_STORE_POSTGRES_URL_H_
#define ROLLGAIT_SERVER_STORE_POSTGRES_URL_H_

#include <string>

#include "server/base/outcome.h"

namespace rollgait::server {

// True for postgresql:// and postgres://.
bool IsPostgresUrl(const std::string& text);

// The URL with every password replaced by "***", for logs and messages.
std::string WithoutPassword(const std::string& url);

// kInvalidArgument, without any password in the message, if libpq cannot read the URL.
Outcome<Done> CheckPostgresUrl(const std::string& url);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_POSTGRES_URL_H_
