#ifndef ROLLGAIT_SERVER_SERVICE_FILTER_CHECK_H_
#define ROLLGAIT_SERVER_SERVICE_FILTER_CHECK_H_

#include "rollgait/v1/gait_service.pb.h"
#include "server/base/outcome.h"
#include "server/store/list_query.h"

namespace rollgait::server {

// Fills what the request's state and filter ask for into the query. What is wrong with them joins `violations`.
void ReadFilter(const v1::ListSolvesRequest& request, ListQuery* query, Violations* violations);

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_SERVICE_FILTER_CHECK_H_
