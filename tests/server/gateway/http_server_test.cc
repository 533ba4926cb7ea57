#include "server/gateway/http_server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <filesystem>
#include <future>
#include <thread>

#include "server/gateway/health.h"
#include "server/gateway/problem.h"
#include "tests/server/store/temporary_directory.h"

namespace rollgait::server {
namespace {

using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr std::chrono::seconds kLong{30};  // for what must come
constexpr milliseconds kSomeTicks{700};    // in which the server looks at its connections twice

// Hands what it is asked to the test.
class TestService final : public HttpService {
 public:
  HttpHeaders HeadersFor(const HttpRequest&) const override { return {{"X-Own", "yes"}}; }
  void Admit(const HttpRequest& head, std::shared_ptr<HttpAnswer> answer) override { on_admit(head, answer); }
  void Handle(HttpRequest request, std::shared_ptr<HttpAnswer> answer) override {
    handled.set_value({std::move(request), std::move(answer)});
  }

  struct Asked {
    HttpRequest request;
    std::shared_ptr<HttpAnswer> answer;
  };
  // The next request, which must come.
  Asked Next() {
    auto future = handled.get_future();
    EXPECT_EQ(future.wait_for(kLong), std::future_status::ready);
    Asked asked = future.get();
    handled = {};
    return asked;
  }

  std::function<void(const HttpRequest&, std::shared_ptr<HttpAnswer>)> on_admit;
  std::promise<Asked> handled;
};

HttpResponse Good() { return {200, {}, "text/plain", std::make_shared<const std::string>("good")}; }

class Client {
 public:
  explicit Client(const std::string& path) : fd_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    path.copy(name.sun_path, sizeof name.sun_path - 1);
    EXPECT_EQ(connect(fd_, reinterpret_cast<const sockaddr*>(&name), sizeof name), 0) << path;
  }
  ~Client() { close(fd_); }
  void Write(const std::string& text) const {
    EXPECT_EQ(send(fd_, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  // Until the server closes, or `end` has come.
  std::string Read(const std::string& end = "") const {
    std::string text;
    char bytes[4096];
    for (ssize_t count = 0; (count = recv(fd_, bytes, sizeof bytes, 0)) > 0;) {
      text.append(bytes, static_cast<size_t>(count));
      if (!end.empty() && text.find(end) != std::string::npos) break;
    }
    return text;
  }

 private:
  const int fd_;
};

constexpr char kGet[] = "GET /a HTTP/1.1\r\nHost: localhost\r\n\r\n";

std::string Post(size_t bytes, const std::string& more = "") {
  return "POST /a HTTP/1.1\r\nHost: localhost\r\nContent-Length: " + std::to_string(bytes) + "\r\n" + more + "\r\n";
}

class HttpServerTest : public testing::Test {
 protected:
  std::unique_ptr<HttpServer> Start(const HttpLimits& limits) {
    auto server = HttpServer::Start("unix:" + path_, limits, service_);
    EXPECT_TRUE(server.ok());
    return std::move(server).value();
  }

  const TemporaryDirectory directory_;
  const std::string path_ = directory_.path() + "/gateway.sock";
  TestService service_;
};

TEST_F(HttpServerTest, WhoBeginsToListenLateIsToldThatTheClientWaits) {
  HttpLimits limits;
  limits.patience = milliseconds(1);
  const auto server = Start(limits);
  const Client client(path_);
  client.Write(kGet);
  const auto asked = service_.Next();
  std::this_thread::sleep_for(kSomeTicks);
  std::promise<void> told;
  ASSERT_TRUE(asked.answer->Listen({[&] { told.set_value(); }, {}, {}, {}, {}}));
  EXPECT_EQ(told.get_future().wait_for(kLong), std::future_status::ready);
  asked.answer->Send(Good());
  EXPECT_THAT(client.Read("good"), StartsWith("HTTP/1.1 200"));
}

TEST_F(HttpServerTest, AClientThatLeavesIsNoticedBeforeAnythingIsWritten) {
  const auto server = Start({});
  for (const bool streams : {false, true}) {
    auto client = std::make_unique<Client>(path_);
    client->Write(kGet);
    const auto asked = service_.Next();
    const auto closed = std::make_shared<std::promise<void>>();  // also for a call that comes too late
    ASSERT_TRUE(asked.answer->Listen({{}, {}, {}, {}, [closed] { closed->set_value(); }}));
    if (streams) {
      asked.answer->Begin({});
      asked.answer->Push(": here\n\n");
      EXPECT_THAT(client->Read(": here"), HasSubstr("text/event-stream"));
    }
    client.reset();
    EXPECT_EQ(closed->get_future().wait_for(kLong), std::future_status::ready) << "streams: " << streams;
  }
}

TEST_F(HttpServerTest, LongBodiesComeWhenTheyAreLetIn) {
  const auto server = Start({});
  const std::string body(100'000, 'x');
  service_.on_admit = [](const HttpRequest&, const std::shared_ptr<HttpAnswer>& answer) {
    answer->Send(ProblemResponse(MakeProblem(401, grpc::StatusCode::UNAUTHENTICATED, "who are you"), {}));
  };
  const Client refused(path_);
  refused.Write(Post(body.size()));
  EXPECT_THAT(refused.Read(), AllOf(StartsWith("HTTP/1.1 401"), HasSubstr("who are you"), HasSubstr("close")));

  std::shared_ptr<HttpAnswer> asks;
  std::promise<std::string> admitted;
  service_.on_admit = [&](const HttpRequest& head, std::shared_ptr<HttpAnswer> answer) {
    asks = std::move(answer);
    admitted.set_value(head.peer + " " + head.uri);
  };
  const Client client(path_);
  client.Write(Post(body.size(), "Expect: 100-continue\r\n"));
  EXPECT_EQ(admitted.get_future().get(), "unix /a");
  auto place = std::make_shared<const std::string>("a");
  asks->TakeBody(place);
  EXPECT_THAT(client.Read("\r\n\r\n"), StartsWith("HTTP/1.1 100"));
  client.Write(body);
  {
    const auto asked = service_.Next();
    EXPECT_EQ(asked.request.body, body);
    EXPECT_EQ(asked.request.place, place);
    asked.answer->Send(Good());
  }
  EXPECT_THAT(client.Read("good"), StartsWith("HTTP/1.1 200"));
}

TEST_F(HttpServerTest, BodiesMustArriveAtARate) {
  HttpLimits limits;
  limits.body_time = milliseconds(0);
  limits.body_bytes_per_s = 1;
  const auto server = Start(limits);
  const Client slow(path_), steady(path_);
  slow.Write(Post(100));
  steady.Write(Post(100) + std::string(50, 'x'));
  EXPECT_EQ(slow.Read(), "");  // closed without an answer
  std::this_thread::sleep_for(kSomeTicks);
  steady.Write(std::string(50, 'x'));
  service_.Next().answer->Send(Good());
  EXPECT_THAT(steady.Read("good"), StartsWith("HTTP/1.1 200"));
}

TEST_F(HttpServerTest, RefusalsOfTheServerHaveTheHeadersOfTheService) {
  const auto server = Start({});
  const Client client(path_);
  client.Write(Post(kMaxRequestBytes + 1));
  EXPECT_THAT(client.Read(), AllOf(StartsWith("HTTP/1.1 413"), HasSubstr("X-Own: yes"), HasSubstr("4194304")));
}

TEST_F(HttpServerTest, AStopLetsAnswersComeAndEndsStreams) {
  auto server = Start({});
  const Client once(path_), streams(path_), never(path_), half(path_);
  half.Write("GET /a HT");
  once.Write(kGet);
  const auto first = service_.Next();
  streams.Write(kGet);
  const auto second = service_.Next();
  never.Write(kGet);
  const auto third = service_.Next();
  std::promise<void> stopped;
  ASSERT_TRUE(second.answer->Listen({{},
                                     {},
                                     {},
                                     [&] {
                                       second.answer->End("event: end\ndata: stops\n\n");
                                       stopped.set_value();
                                     },
                                     {}}));
  second.answer->Begin({});
  std::thread stop([&] { server->Stop(milliseconds(1500)); });
  EXPECT_EQ(stopped.get_future().wait_for(kLong), std::future_status::ready);
  first.answer->Send(Good());
  EXPECT_THAT(once.Read(), AllOf(StartsWith("HTTP/1.1 200"), HasSubstr("good"), HasSubstr("Connection: close")));
  EXPECT_THAT(streams.Read(), HasSubstr("data: stops"));
  EXPECT_THAT(never.Read(),
              AllOf(StartsWith("HTTP/1.1 503"), HasSubstr("the gateway stops"), HasSubstr("Retry-After")));
  EXPECT_EQ(half.Read(), "");
  stop.join();
}

TEST_F(HttpServerTest, AServerThatEndsLeavesItsSuccessorsSocket) {
  auto old_server = Start({});
  const Client client(path_);
  client.Write(kGet);
  const auto asked = service_.Next();
  std::thread stop([&] { old_server->Stop(kLong); });
  // Free from the first moment of the stop on.
  TestService new_service;
  std::unique_ptr<HttpServer> successor;
  for (int i = 0; i < 3000 && successor == nullptr; ++i) {
    auto started = HttpServer::Start("unix:" + path_, {}, new_service);
    if (started.ok()) successor = std::move(started).value();
    std::this_thread::sleep_for(milliseconds(10));
  }
  ASSERT_NE(successor, nullptr);
  asked.answer->Send(Good());
  stop.join();
  ASSERT_TRUE(std::filesystem::exists(path_));
  const Client next(path_);
  next.Write(kGet);
  new_service.Next().answer->Send(Good());
  EXPECT_THAT(next.Read("good"), StartsWith("HTTP/1.1 200"));
  successor.reset();
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(HttpServerTest, HealthIsAnAnswerWith200) {
  EXPECT_THAT(AskForHealth("unix:" + path_).error().message, HasSubstr("No such file"));
  const auto server = Start({});
  const auto ask = [&](const HttpResponse& response) {
    auto health = std::async(std::launch::async, [&] { return AskForHealth("unix:" + path_); });
    const auto asked = service_.Next();
    EXPECT_EQ(asked.request.verb + " " + asked.request.uri, "HEAD /v1/openapi.json");
    asked.answer->Send(response);
    return health.get();
  };
  EXPECT_TRUE(ask(Good()).ok());
  const Outcome<Done> ill = ask(ProblemResponse(MakeProblem(503, grpc::StatusCode::UNAVAILABLE, "no"), {}));
  ASSERT_FALSE(ill.ok());
  EXPECT_THAT(ill.error().message, HasSubstr("HTTP/1.1 503"));
}

}  // namespace
}  // namespace rollgait::server
