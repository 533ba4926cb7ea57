#include "server/base/log_writer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "server/base/rate_limit.h"

namespace rollgait::server {
namespace {

// A pipe whose reader reads when it is told to.
class LogWriterTest : public testing::Test {
 protected:
  LogWriterTest() { EXPECT_EQ(pipe2(ends_, O_CLOEXEC), 0); }
  ~LogWriterTest() override {
    close(ends_[0]);
    if (ends_[1] >= 0) close(ends_[1]);
  }
  LogWriter::Options To(size_t most_bytes) const {
    return {ends_[1], most_bytes, [](int64_t lines) { return "dropped " + std::to_string(lines) + "\n"; }};
  }
  // What was written until the last writer closes.
  std::string ReadAll() {
    close(ends_[1]);
    ends_[1] = -1;
    std::string text;
    char block[4096];
    for (ssize_t count; (count = read(ends_[0], block, sizeof block)) > 0;)
      text.append(block, static_cast<size_t>(count));
    return text;
  }

  int ends_[2] = {-1, -1};
};

TEST_F(LogWriterTest, WritesLinesInTheirOrder) {
  std::string expected;
  {
    LogWriter writer(To(1 << 20));
    for (int i = 0; i < 100; ++i) {
      writer.Write(std::to_string(i) + "\n");
      expected += std::to_string(i) + "\n";
    }
    EXPECT_TRUE(writer.Flush(std::chrono::minutes(1)));
    EXPECT_EQ(writer.dropped(), 0);
  }
  EXPECT_EQ(ReadAll(), expected);
}

// The reader stands still: nobody waits, the oldest lines go, and the next line that is written says how many.
TEST_F(LogWriterTest, AReaderThatStandsStillHoldsUpNobody) {
  ASSERT_GT(fcntl(ends_[1], F_SETPIPE_SZ, 4096), 0);
  LogWriter writer(To(100'000));
  const std::string line = std::string(999, 'x') + "\n";
  for (int i = 0; i < 10'000; ++i) writer.Write(line);
  EXPECT_FALSE(writer.Flush(std::chrono::milliseconds(10)));
  EXPECT_GT(writer.dropped(), 9'800);
  EXPECT_LT(writer.dropped(), 9'910);
  const std::string counted = "dropped " + std::to_string(writer.dropped()) + "\n";
  std::string text;
  char block[4096];
  while (!text.ends_with("last\n")) {
    if (text.empty()) writer.Write("last\n");  // is dropped last
    const ssize_t count = read(ends_[0], block, sizeof block);
    ASSERT_GT(count, 0);
    text.append(block, static_cast<size_t>(count));
  }
  EXPECT_NE(text.find("dropped "), std::string::npos);
  EXPECT_LE(text.size(), 100'000u + 2 * 4096u + counted.size());
}

TEST_F(LogWriterTest, EndsWhileTheReaderStandsStill) {
  ASSERT_GT(fcntl(ends_[1], F_SETPIPE_SZ, 4096), 0);
  {
    LogWriter writer(To(1 << 20));
    for (int i = 0; i < 100; ++i) writer.Write(std::string(999, 'x') + "\n");
  }
  char block[4096];
  EXPECT_GT(read(ends_[0], block, sizeof block), 0);  // lets the thread go on, which ends
}

TEST(RateLimitTest, LetsSoManyThroughAndCountsTheOthers) {
  RateLimit limit(3);
  int64_t through = 0, counted = 0;
  for (int i = 0; i < 100; ++i) {
    if (const auto before = limit.Take()) {
      ++through;
      counted += *before;
    }
  }
  // The loop may lie in two seconds.
  EXPECT_TRUE(through == 3 || through == 6) << through;
  EXPECT_LE(counted, 97);
  RateLimit none(0);
  EXPECT_FALSE(none.Take().has_value());
}

}  // namespace
}  // namespace rollgait::server
