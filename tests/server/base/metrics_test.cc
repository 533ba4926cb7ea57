#include "server/base/metrics.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/scrape.h"

namespace rollgait::server {
namespace {

TEST(MetricsTest, AreServedInTheExpositionFormat) {
  Metrics metrics("tester", "1.2.3", "a \"build\"\\");
  CounterFamily(metrics, "rollgait_things_total", "Things").Add({{"kind", "good"}}).Increment(3);
  const Outcome<std::string> address = metrics.Listen("127.0.0.1:0");
  ASSERT_TRUE(address.ok()) << address.error().message;
  const std::map<std::string, double> samples = ParseExposition(Scrape(address.value()));
  EXPECT_EQ(samples.at("rollgait_things_total{kind=\"good\"}"), 3);
  EXPECT_EQ(samples.at("rollgait_build_info{build=\"a \\\"build\\\"\\\\\",program=\"tester\",version=\"1.2.3\"}"), 1);
  EXPECT_GT(samples.at("process_resident_memory_bytes"), 1e6);
  EXPECT_GT(samples.at("process_open_fds"), 3);
  EXPECT_GE(samples.at("process_max_fds"), samples.at("process_open_fds"));
  EXPECT_GE(samples.at("process_threads"), 1);
  EXPECT_GT(samples.at("process_start_time_seconds"), 1.6e9);
  EXPECT_GE(samples.at("process_cpu_seconds_total"), 0);
}

// Half requests hold threads of the listener, each for at most a second.
TEST(MetricsTest, AreServedBesideHalfRequests) {
  Metrics metrics("tester", "", "");
  const Outcome<std::string> address = metrics.Listen("127.0.0.1:0");
  ASSERT_TRUE(address.ok());
  std::vector<int> halves;
  for (int i = 0; i < 20; ++i) {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<uint16_t>(std::stoi(address.value().substr(address.value().rfind(':') + 1))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    halves.push_back(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    ASSERT_EQ(connect(halves.back(), reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
    ASSERT_EQ(write(halves.back(), "GET /met", 8), 8);
  }
  EXPECT_NE(Scrape(address.value()).find("rollgait_build_info"), std::string::npos);
  // Each is given up: the server closes, also without an answer.
  for (const int fd : halves) {
    char block[4096];
    while (read(fd, block, sizeof block) > 0) {
    }
    close(fd);
  }
}

TEST(MetricsTest, AnAddressThatCannotBeServedIsNamed) {
  Metrics first("tester", "", ""), second("tester", "", "");
  const Outcome<std::string> address = first.Listen("127.0.0.1:0");
  ASSERT_TRUE(address.ok());
  const Outcome<std::string> taken = second.Listen(address.value());
  ASSERT_FALSE(taken.ok());
  EXPECT_EQ(taken.error().code, ErrorCode::kUnavailable);
  EXPECT_NE(taken.error().message.find(address.value()), std::string::npos);
  for (const char* bad : {"", "9464", ":9464", "127.0.0.1:", "127.0.0.1:http", "127.0.0.1:65536"}) {
    const Outcome<std::string> refused = second.Listen(bad);
    ASSERT_FALSE(refused.ok()) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument) << bad;
  }
}

TEST(MetricsTest, ALabelHasSoManyValuesAndNoMore) {
  BoundedLabel label(2);
  EXPECT_EQ(label.Of("a"), "a");
  EXPECT_EQ(label.Of("b"), "b");
  EXPECT_EQ(label.Of("c"), "other");
  EXPECT_EQ(label.Of("a"), "a");
}

}  // namespace
}  // namespace rollgait::server
