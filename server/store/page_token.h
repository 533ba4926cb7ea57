#ifndef ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_
#define ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/list_query.h"

namespace rollgait::server {

// Where the next page begins, as a text that callers hand back unread: it names the filter it was made for and carries
// a check sum, so that a damaged or foreign token is recognised. It grants nothing, and whoever does not know the
// secret cannot tell the number, which counts the solves of all tenants. `before_number` >= 0.
std::string MakePageToken(int64_t before_number, const ListQuery& query, const std::string& secret);

// The number the query's page lies below; nullopt if its token is not ours or was made for another state,
// tenant or filter.
std::optional<int64_t> ParsePageToken(const ListQuery& query, const std::string& secret);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_
