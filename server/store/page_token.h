#ifndef ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_
#define ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_

#include <cstdint>
#include <optional>
#include <string>

#include "server/store/solve_record.h"

namespace rollgait::server {

// Where the next page begins, as a text that callers hand back unread: it names the filter it was made for and carries
// a check sum, so that a damaged or foreign token is recognised. It grants nothing.
std::string MakePageToken(int64_t before_number, const std::optional<SolveState>& state);

// The number the page lies below; nullopt if the token is not ours or was made for another filter.
std::optional<int64_t> ParsePageToken(const std::string& token, const std::optional<SolveState>& state);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_STORE_PAGE_TOKEN_H_
