#include "server/base/framing.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace rollgait::server {
namespace {

using namespace std::string_literals;

// Two connected sockets, closed at the end of the test.
class Framing : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  void TearDown() override {
    CloseWriter();
    close(ends_[0]);
  }
  void CloseWriter() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }
  void Send(const std::string& bytes) {
    ASSERT_EQ(send(ends_[1], bytes.data(), bytes.size(), 0), static_cast<ssize_t>(bytes.size()));
  }
  int reader() const { return ends_[0]; }
  int writer() const { return ends_[1]; }

  std::array<int, 2> ends_ = {-1, -1};
  std::string payload_;
};

std::string LargePayload() {
  std::string payload(3'000'000, '\0');
  for (size_t i = 0; i < payload.size(); ++i) payload[i] = static_cast<char>(i * 7919 >> 3);
  return payload;
}

TEST_F(Framing, HeaderIsWrittenAsDocumented) { EXPECT_EQ(EncodeFrame("hello"), "RGF1\5\0\0\0hello"s); }

TEST_F(Framing, LengthIsLittleEndian) {
  EXPECT_EQ(EncodeFrame(std::string(0x010203, 'x')).substr(0, 8), "RGF1\3\2\1\0"s);
}

TEST_F(Framing, FramesArriveInOrderAndThenTheEnd) {
  ASSERT_EQ(WriteFrame(writer(), "one"), FrameStatus::kOk);
  ASSERT_EQ(WriteFrame(writer(), ""), FrameStatus::kOk);
  CloseWriter();
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kOk);
  EXPECT_EQ(payload_, "one");
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kOk);
  EXPECT_EQ(payload_, "");
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kEnd);
}

TEST_F(Framing, AFrameLargerThanTheSocketBufferArrivesWhole) {
  const std::string sent = LargePayload();
  std::thread sender([&] { EXPECT_EQ(WriteFrame(writer(), sent), FrameStatus::kOk); });
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kOk);
  sender.join();
  EXPECT_TRUE(payload_ == sent);
}

std::atomic<int> signals_handled{0};

TEST_F(Framing, SignalsDoNotInterruptAFrame) {
  struct sigaction action {};
  action.sa_handler = [](int) { ++signals_handled; };  // without SA_RESTART: read and send return EINTR
  struct sigaction before {};
  ASSERT_EQ(sigaction(SIGUSR1, &action, &before), 0);
  const std::string sent = LargePayload();
  const pthread_t receiver = pthread_self();
  std::thread sender([&] {
    for (int i = 0; i < 50; ++i) {
      pthread_kill(receiver, SIGUSR1);
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
    EXPECT_EQ(WriteFrame(writer(), sent), FrameStatus::kOk);
  });
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kOk);
  sender.join();
  sigaction(SIGUSR1, &before, nullptr);
  EXPECT_GT(signals_handled.load(), 0);
  EXPECT_TRUE(payload_ == sent);
}

TEST_F(Framing, EveryProperPrefixIsTruncated) {
  const std::string frame = EncodeFrame("abcdef");
  for (size_t length = 1; length < frame.size(); ++length) {
    Send(frame.substr(0, length));
    CloseWriter();
    EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kTruncated) << length << " bytes";
    TearDown();
    SetUp();
  }
}

TEST_F(Framing, GarbageIsRecognised) {
  Send("Error: out of cheese\n");
  EXPECT_EQ(ReadFrame(reader(), &payload_), FrameStatus::kGarbage);
}

TEST_F(Framing, AHostileLengthIsRefusedBeforeMemoryIsTaken) {
  Send("RGF1\xff\xff\xff\xff"s);
  EXPECT_EQ(ReadFrame(reader(), &payload_, 1000), FrameStatus::kTooLarge);
  EXPECT_TRUE(payload_.empty());
}

TEST_F(Framing, TheLimitItselfIsAccepted) {
  ASSERT_EQ(WriteFrame(writer(), "12345"), FrameStatus::kOk);
  EXPECT_EQ(ReadFrame(reader(), &payload_, 5), FrameStatus::kOk);
  ASSERT_EQ(WriteFrame(writer(), "12345"), FrameStatus::kOk);
  EXPECT_EQ(ReadFrame(reader(), &payload_, 4), FrameStatus::kTooLarge);
}

TEST_F(Framing, WritingToNobodyIsAnErrorAndNoSignal) {
  close(ends_[0]);
  ends_[0] = -1;
  EXPECT_EQ(WriteFrame(writer(), "hello"), FrameStatus::kError);
  EXPECT_EQ(errno, EPIPE);
}

TEST_F(Framing, ParserCutsAStreamThatArrivesByteByByte) {
  FrameParser parser;
  const std::string stream = EncodeFrame("first") + EncodeFrame("") + EncodeFrame("third");
  std::vector<std::string> payloads;
  for (const char byte : stream) {
    parser.Append({&byte, 1});
    while (parser.Next(&payload_) == FrameStatus::kOk) payloads.push_back(payload_);
  }
  EXPECT_EQ(payloads, (std::vector<std::string>{"first", "", "third"}));
  EXPECT_TRUE(parser.AtBoundary());
}

TEST_F(Framing, ParserSeesGarbageInTheFirstBytes) {
  FrameParser parser;
  parser.Append("RG");
  EXPECT_EQ(parser.Next(&payload_), FrameStatus::kNeedMore);
  parser.Append("X");
  EXPECT_EQ(parser.Next(&payload_), FrameStatus::kGarbage);
}

TEST_F(Framing, ReadAvailableDoesNotWait) {
  ASSERT_EQ(fcntl(reader(), F_SETFL, O_NONBLOCK), 0);
  FrameParser parser;
  EXPECT_EQ(ReadAvailable(reader(), &parser), FrameStatus::kNeedMore);
  Send(EncodeFrame("hello") + "RGF1");
  EXPECT_EQ(ReadAvailable(reader(), &parser), FrameStatus::kOk);
  EXPECT_EQ(parser.Next(&payload_), FrameStatus::kOk);
  EXPECT_EQ(parser.Next(&payload_), FrameStatus::kNeedMore);
  CloseWriter();
  EXPECT_EQ(ReadAvailable(reader(), &parser), FrameStatus::kTruncated);
}

TEST_F(Framing, ReadAvailableFindsTheEndAfterTheLastFrame) {
  ASSERT_EQ(fcntl(reader(), F_SETFL, O_NONBLOCK), 0);
  FrameParser parser;
  const std::string sent(65536 - 8,
                         'x');  // the frame fills one read exactly, so that the end is found in the same call
  Send(EncodeFrame(sent));
  CloseWriter();
  EXPECT_EQ(ReadAvailable(reader(), &parser), FrameStatus::kOk);
  EXPECT_EQ(parser.Next(&payload_), FrameStatus::kOk);
  EXPECT_TRUE(payload_ == sent);
  EXPECT_EQ(ReadAvailable(reader(), &parser), FrameStatus::kEnd);
}

TEST_F(Framing, RandomBytesNeverParseForEver) {
  std::mt19937 random(7);
  for (int run = 0; run < 2000; ++run) {
    FrameParser parser(1000);
    std::string bytes = run % 2 == 0 ? "RGF1" : "";
    for (int i = 0; i < 64; ++i) bytes.push_back(static_cast<char>(random()));
    parser.Append(bytes);
    FrameStatus status = FrameStatus::kOk;
    int frames = 0;
    while (status == FrameStatus::kOk) {
      status = parser.Next(&payload_);
      ASSERT_LE(++frames, 9) << "64 bytes hold at most eight frames";
    }
    EXPECT_NE(status, FrameStatus::kOk);
  }
}

}  // namespace
}  // namespace rollgait::server
