#ifndef ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_
#define ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_

#include <cstddef>

namespace rollgait::server {

// Bytes of one record of a wire::Journal, and of all of a solve. A record beyond is not kept, nor is any that follows:
// a solve that is tried again goes on from the last that was. human29 with 200 intervals has records of about 7 MB.
inline constexpr size_t kMaxRecordBytes = size_t{32} << 20;
inline constexpr size_t kMaxJournalBytes = size_t{64} << 20;

}  // namespace rollgait::server

#endif  // ROLLGAIT_SERVER_BASE_JOURNAL_LIMITS_H_
