#include "server/base/logging.h"

#include <gtest/gtest.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

namespace rollgait::server {
namespace {

// What `act` writes to standard error, line by line.
template <typename Act>
std::vector<std::string> Lines(LogFormat format, const Act& act) {
  testing::internal::CaptureStderr();
  StartLogging({"tester", format, "info"});
  act();
  spdlog::set_default_logger(std::make_shared<spdlog::logger>("none"));
  spdlog::drop("tester");  // Debian 13's spdlog keeps it; with it go the lines that wait to be written
  std::vector<std::string> lines(1);
  for (const char c : testing::internal::GetCapturedStderr()) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  EXPECT_EQ(lines.back(), "");  // every line ends
  lines.pop_back();
  return lines;
}

nlohmann::json Only(const std::vector<std::string>& lines) {
  EXPECT_EQ(lines.size(), 1u);
  return nlohmann::json::parse(lines.at(0));  // strict: refuses bad UTF-8, control characters, trailing text
}

TEST(LoggingTest, AnEventIsOneJsonObjectOnOneLine) {
  const nlohmann::json line = Only(Lines(LogFormat::kJson, [] {
    LogEvent(spdlog::level::info, "solve.claimed", {{"attempt", 2}, {"share", 0.5}, {"last", true}, {"solve", "abc"}});
  }));
  EXPECT_EQ(line["program"], "tester");
  EXPECT_EQ(line["level"], "info");
  EXPECT_EQ(line["event"], "solve.claimed");
  EXPECT_EQ(line["attempt"], 2);
  EXPECT_EQ(line["share"], 0.5);
  EXPECT_EQ(line["last"], true);
  EXPECT_EQ(line["solve"], "abc");
  EXPECT_EQ(line["ts"].get<std::string>().size(), std::string("2026-11-21T20:59:17.123456Z").size());
}

TEST(LoggingTest, NoTextEndsItsLineOrItsField) {
  const std::string nasty[] = {"two\nlines", "\"quoted\"", "a\\", "\r\x1b[2J\x7f", std::string("nul\0nul", 7),
                               "Grüße, 歩"};
  for (const std::string& text : nasty) {
    for (const bool as_message : {true, false}) {
      const auto write = [&] {
        if (as_message) {
          spdlog::info("{}", text);
        } else {
          LogEvent(spdlog::level::info, "call.finished", {{"reason", text}});
        }
      };
      EXPECT_EQ(Only(Lines(LogFormat::kJson, write))[as_message ? "message" : "reason"], text);
      EXPECT_EQ(Lines(LogFormat::kText, write).size(), 1u) << text;
    }
  }
}

TEST(LoggingTest, BytesThatAreNoUtf8AreReplaced) {
  // A lone continuation, an overlong slash, a surrogate, a sequence that is cut off.
  const std::string nasty =
      "a\x80"
      "b\xc0\xaf"
      "c\xed\xa0\x80"
      "d\xe2\x82";
  const std::string mark = "\xef\xbf\xbd";
  EXPECT_EQ(Only(Lines(LogFormat::kJson,
                       [&] {
                         LogEvent(spdlog::level::info, "x", {{"text", nasty}});
                       }))["text"],
            "a" + mark + "b" + mark + mark + "c" + mark + mark + mark + "d" + mark + mark);
}

TEST(LoggingTest, AForgedFieldStaysInsideItsValue) {
  const std::string forged = "x\",\"level\":\"error\",\"tenant\":\"root";
  const nlohmann::json line = Only(Lines(LogFormat::kJson, [&] {
    LogEvent(spdlog::level::info, "x", {{"text", forged}});
  }));
  EXPECT_EQ(line["text"], forged);
  EXPECT_EQ(line["level"], "info");
  EXPECT_FALSE(line.contains("tenant"));
  const std::string text = Lines(LogFormat::kText, [] {
                             LogEvent(spdlog::level::info, "x", {{"text", "a tenant=root"}});
                           }).at(0);
  EXPECT_NE(text.find("text=\"a tenant=root\""), std::string::npos) << text;
}

TEST(LoggingTest, LongValuesAreCut) {
  const nlohmann::json line = Only(Lines(LogFormat::kJson, [] {
    LogEvent(spdlog::level::info, "x", {{"text", std::string(1'000'000, 'y')}});
  }));
  EXPECT_LT(line["text"].get<std::string>().size(), 5000u);
}

TEST(LoggingTest, ScopesGiveTheirFieldsToEveryLineOfTheirThread) {
  const std::vector<std::string> lines = Lines(LogFormat::kJson, [] {
    const LogFields call = {{"solve", "outer"}, {"request_id", "r1"}, {"tenant", ""}};
    const LogScope scope(call);
    {
      const LogFields run = {{"solve", "inner"}};
      const LogScope inner(run);
      spdlog::warn("plain");
    }
    LogEvent(spdlog::level::info, "x");
    std::thread([] { spdlog::info("another thread"); }).join();
  });
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(nlohmann::json::parse(lines[0])["solve"], "inner");
  EXPECT_EQ(nlohmann::json::parse(lines[0])["request_id"], "r1");
  EXPECT_FALSE(nlohmann::json::parse(lines[0]).contains("tenant"));
  EXPECT_EQ(nlohmann::json::parse(lines[1])["solve"], "outer");
  EXPECT_FALSE(nlohmann::json::parse(lines[2]).contains("solve"));
}

TEST(LoggingTest, LevelsBelowTheChosenOneAreNotWritten) {
  EXPECT_TRUE(Lines(LogFormat::kJson, [] { LogEvent(spdlog::level::debug, "x"); }).empty());
}

TEST(LoggingTest, NumbersThatAreNoneAreText) {
  const nlohmann::json line = Only(Lines(LogFormat::kJson, [] {
    LogEvent(spdlog::level::info, "x", {{"a", 0.0 / 0.0}, {"b", -1.0 / 0.0}});
  }));
  EXPECT_EQ(line["a"], "NaN");
  EXPECT_EQ(line["b"], "-Infinity");
}

}  // namespace
}  // namespace rollgait::server
