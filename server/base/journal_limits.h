#ifndef ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_
#define ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_

#include <cstddef>

namespace rollgait::server {

// Bytes of one record of a wire::Journal, and of all of a solve. A record beyond is not kept, nor is any that follows:
// a solve that is tried again goes on from the last that was. human29 at fine accuracy with estimated
// errors leaves 2.4 MB in all (e2e.outliving_test).
inline constexpr size_t kMaxRecordBytes = size_t{32} << 20;
inline constexpr size_t kMaxJournalBytes = size_t{64} << 20;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_
