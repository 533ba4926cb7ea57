// Page tokens: one that is taken is one that was given for the same list.
#include <cstring>
#include <string>

#include "server/store/page_token.h"
#include "tests/fuzz/fuzz_target.h"

using namespace rollgait;

namespace {
const std::string kSecret = "of the store";
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t max_size, unsigned) {
  return LLVMFuzzerMutate(data, size, max_size);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) return 0;
  server::ListQuery query;
  if (data[0] % 3 == 1) query.state = server::SolveState::kQueued;
  if (data[0] % 5 == 1) query.tenant = "gaits";
  if (data[0] % 7 == 1) query.filter.labels = {{"sweep", "hills"}};
  query.page_token.assign(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (server::ParsePageToken(query, kSecret)) {
    server::ListQuery other = query;
    other.tenant = "others";
    ROLLGAIT_CHECK(!server::ParsePageToken(other, kSecret));
    server::ListQuery filtered = query;
    filtered.filter.model += "other";
    ROLLGAIT_CHECK(!server::ParsePageToken(filtered, kSecret));
    ROLLGAIT_CHECK(!server::ParsePageToken(query, "the secret of another store"));
  }
  int64_t number = 0;
  std::memcpy(&number, data, std::min(size, sizeof number));
  number &= INT64_MAX;  // rows are numbered from 1
  query.page_token = server::MakePageToken(number, query, kSecret);
  ROLLGAIT_CHECK(server::ParsePageToken(query, kSecret) == number);
  return 0;
}
