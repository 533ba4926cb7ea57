#include "server/gateway/upstream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace rollgait::server {
namespace {

TEST(Upstream, MetadataThatNoCallCanCarryEndsItAtOnce) {
  const Upstream upstream("unix:/nowhere");
  for (const std::string& value :
       std::vector<std::string>{"Bearer \xc3\xa9", "a\tb", "\x7f", std::string(1, '\0'), "\n"}) {
    grpc::Status status;
    const auto call = UpstreamCall::Start(
        upstream.channel(),
        {"/rollgait.v1.GaitService/GetServerInfo", "", {{"authorization", value}}, std::chrono::milliseconds(1000)},
        {[](const std::string&) {}, [&](const CallEnd& end) { status = end.status; }});
    EXPECT_EQ(status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
    EXPECT_THAT(status.error_message(), testing::HasSubstr("authorization"));
    call->ReadNext();
    call->Cancel();
  }
}

}  // namespace
}  // namespace rollgait::server
