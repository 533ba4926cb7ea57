#include "client/view/page_server.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "client/failure.h"
#include "client/view/http_library.h"

namespace rollgait::client {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class PageServerTest : public ::testing::Test {
 protected:
  static std::string Make(const std::string& nonce) { return std::string(200'000, 'x') + "nonce " + nonce; }
  std::string Path() const { return server_.url().substr(server_.url().find('/', 7)); }
  int Port() const { return std::stoi(server_.url().substr(sizeof("http://127.0.0.1:") - 1)); }
  httplib::Client Client() const { return httplib::Client("127.0.0.1", Port()); }

  // Of a feed that has ended; waits for streams that are about to end. The bound only ends a hung test.
  bool HasRoomForAStream() const {
    for (int i = 0; i < 3000; ++i) {
      if (Client().Get(Path() + "events")->status == 200) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  LiveFeed feed_;
  PageServer server_{0, Make, feed_};
};

TEST_F(PageServerTest, HandsOutThePageWithANonceOfItsOwn) {
  EXPECT_THAT(server_.url(), MatchesRegex("http://127\\.0\\.0\\.1:[0-9]+/[0-9a-f]*/"));
  EXPECT_EQ(Path().size(), 34u);
  std::string before;
  for (int i = 0; i < 2; ++i) {
    const httplib::Result page = Client().Get(Path());
    ASSERT_TRUE(page);
    EXPECT_EQ(page->status, 200);
    ASSERT_EQ(page->body.size(), 200'000 + 6 + 32u);
    const std::string nonce = page->body.substr(200'006), policy = page->get_header_value("Content-Security-Policy");
    EXPECT_THAT(policy, HasSubstr("script-src 'nonce-" + nonce + "';"));
    EXPECT_THAT(policy, HasSubstr("default-src 'none'"));
    EXPECT_THAT(policy, HasSubstr("frame-ancestors 'none'"));
    EXPECT_THAT(policy, Not(HasSubstr("script-src 'unsafe-inline'")));
    EXPECT_NE(nonce, before);
    before = nonce;
  }
}

TEST_F(PageServerTest, RefusesOtherHostsPathsAndMethods) {
  const std::string port = std::to_string(Port());
  for (const auto& [host, status] : std::vector<std::pair<std::string, int>>{{"127.0.0.1:" + port, 200},
                                                                             {"localhost:" + port, 200},
                                                                             {"localhost", 403},
                                                                             {"evil.example:" + port, 403},
                                                                             {"127.0.0.1:1", 403}}) {
    const httplib::Result answer = Client().Get(Path(), {{"Host", host}});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, status) << host;
  }
  std::string other = Path();
  other[1] = other[1] == '0' ? '1' : '0';
  for (const std::string& path : {std::string("/"), other, other + "events", Path() + "x", std::string(5000, '/')}) {
    const httplib::Result answer = Client().Get(path);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 404) << path;
  }
  EXPECT_EQ(Client().Post(Path(), "body", "text/plain")->status, 405);
  EXPECT_EQ(Client().Delete(Path())->status, 405);
}

TEST(PageServerHostTest, ClientsLeavePort80Out) {
  EXPECT_TRUE(NamesServer("127.0.0.1", 80));
  EXPECT_TRUE(NamesServer("localhost", 80));
  EXPECT_TRUE(NamesServer("localhost:80", 80));
  EXPECT_FALSE(NamesServer("localhost", 8080));
  EXPECT_FALSE(NamesServer("evil.example", 80));
  EXPECT_FALSE(NamesServer("", 80));
}

TEST_F(PageServerTest, AnAddressForOneUseLeadsToThePageOnce) {
  const std::string url = server_.MakeUrlForOneUse(), path = url.substr(url.find('/', 7));
  EXPECT_THAT(url, HasSubstr(server_.url().substr(0, server_.url().find('/', 7))));
  EXPECT_THAT(path, Not(HasSubstr(Path().substr(1, 32))));
  EXPECT_EQ(Client().Get(path, {{"Host", "evil.example"}})->status, 403);
  const httplib::Result first = Client().Get(path);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->status, 303);
  EXPECT_EQ(first->get_header_value("Location"), Path());
  EXPECT_EQ(Client().Get(path)->status, 404);
  EXPECT_EQ(Client().Get(Path())->status, 200);
}

TEST_F(PageServerTest, TellsTheEventsOfTheFeedToTheirEnd) {
  feed_.SetState("runs");
  std::thread ending([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    feed_.End();
  });
  const httplib::Result events = Client().Get(Path() + "events");
  ending.join();
  ASSERT_TRUE(events);
  EXPECT_EQ(events->status, 200);
  EXPECT_EQ(events->get_header_value("Content-Type"), "text/event-stream");
  EXPECT_EQ(events->body, "event: begin\ndata: null\n\nevent: state\ndata: \"runs\"\n\nevent: end\ndata: null\n\n");
}

TEST_F(PageServerTest, RefusesStreamsBeyondTheFourthAndStillServesThePage) {
  std::atomic<int> open{0};
  std::vector<std::thread> readers;
  for (int i = 0; i < 4; ++i) {
    readers.emplace_back([this, &open] {
      bool counted = false;
      Client().Get(Path() + "events", [&](const char*, size_t) {
        if (!std::exchange(counted, true)) ++open;
        return true;
      });
    });
  }
  while (open < 4) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const httplib::Result fifth = Client().Get(Path() + "events");
  ASSERT_TRUE(fifth);
  EXPECT_EQ(fifth->status, 503);
  EXPECT_THAT(fifth->body, HasSubstr("4 pages follow the solve already"));
  EXPECT_EQ(Client().Get(Path())->status, 200);
  feed_.End();
  for (std::thread& reader : readers) reader.join();
  EXPECT_TRUE(HasRoomForAStream()) << "their places are free again";
}

TEST_F(PageServerTest, AStreamThatIsLeftGivesItsPlaceBack) {
  for (int i = 0; i < 6; ++i) {
    const httplib::Result left = Client().Get(Path() + "events", [](const char*, size_t) { return false; });
    EXPECT_FALSE(left);
  }
  feed_.End();  // what is told shows that nobody listens
  EXPECT_TRUE(HasRoomForAStream());
}

TEST_F(PageServerTest, APortIsTakenOnce) {
  try {
    const PageServer second(Port(), Make, feed_);
    FAIL() << "two servers on one port";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.code(), ExitCode::kUsage);
    EXPECT_THAT(failure.what(), HasSubstr("--port " + std::to_string(Port()) + ": the port is in use"));
  }
}

// The library would wait five seconds for each byte of each of them.
TEST(PageServerEndTest, EndsWhileConnectionsTrickle) {
  LiveFeed feed;
  auto server = std::make_unique<PageServer>(
      0, [](const std::string&) { return std::string(); }, feed);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<uint16_t>(std::stoi(server->url().substr(sizeof("http://127.0.0.1:") - 1))));
  std::vector<int> sockets;
  for (int i = 0; i < 20; ++i) {
    sockets.push_back(socket(AF_INET, SOCK_STREAM, 0));
    ASSERT_EQ(connect(sockets.back(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  }
  std::atomic<bool> ended{false};
  std::thread trickle([&] {
    for (int i = 0; i < 30 && !ended; ++i) {
      for (const int one : sockets) send(one, "G", 1, MSG_NOSIGNAL);
      std::this_thread::sleep_for(std::chrono::seconds(1));
    }
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto start = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  ended = true;
  trickle.join();
  for (const int one : sockets) close(one);
}

TEST(PageServerEndTest, EndsWhileAStreamIsOpenAndAPageThatFailsSaysWhy) {
  LiveFeed feed;
  auto server = std::make_unique<PageServer>(
      0, [](const std::string&) -> std::string { throw std::runtime_error("no such page can be made"); }, feed);
  const std::string url = server->url();
  const int port = std::stoi(url.substr(sizeof("http://127.0.0.1:") - 1));
  const std::string path = url.substr(url.find('/', 7));
  httplib::Client client("127.0.0.1", port);
  EXPECT_EQ(client.Get(path)->status, 500);
  EXPECT_EQ(client.Get(path)->body, "no such page can be made\n");
  std::atomic<bool> open{false};
  std::thread reader([&] {
    httplib::Client("127.0.0.1", port).Get(path + "events", [&](const char*, size_t) {
      open = true;
      return true;
    });
  });
  while (!open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  server.reset();
  reader.join();
  EXPECT_FALSE(client.Get(path)) << "nobody listens any more";
}

}  // namespace
}  // namespace rollgait::client
