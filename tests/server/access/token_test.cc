#include "server/access/token.h"

#include <gtest/gtest.h>

#include <set>

#include "server/access/caller.h"

namespace rollgait::server {
namespace {

TEST(TokenTest, IsReadBackAndHasItsBits) {
  std::set<std::string> secrets;
  for (int i = 0; i < 100; ++i) {
    const Token token = Token::Random();
    const std::optional<Token> read = Token::Parse(token.Text());
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(read->id, token.id);
    EXPECT_EQ(read->secret, token.secret);
    EXPECT_EQ(token.secret.size(), 52u);  // of 32 letters: 260 bits
    EXPECT_EQ(token.Hash().find(token.secret), std::string::npos);
    secrets.insert(token.secret);
  }
  EXPECT_EQ(secrets.size(), 100u);
}

TEST(TokenTest, OtherTextsAreNone) {
  const std::string good = Token::Random().Text();
  for (const std::string& bad : {std::string(), std::string("rgt_"), good + "a", good.substr(1), "x" + good.substr(1),
                                 good.substr(0, good.size() - 1) + "A", good.substr(0, good.size() - 1) + "\n"}) {
    EXPECT_FALSE(Token::Parse(bad).has_value()) << bad;
  }
}

TEST(TokenTest, HashesAreComparedWhole) {
  const Token token = Token::Random();
  std::string other = token.Hash();
  EXPECT_TRUE(SameHash(token.Hash(), other));
  other.back() = other.back() == '0' ? '1' : '0';
  EXPECT_FALSE(SameHash(token.Hash(), other));
  EXPECT_FALSE(SameHash(token.Hash(), ""));
}

TEST(TokenTest, IsValidUntilItExpiresOrIsRevoked) {
  TokenRecord token;
  EXPECT_TRUE(token.valid_at(5));
  token.expire_time_us = 10;
  EXPECT_TRUE(token.valid_at(9));
  EXPECT_FALSE(token.valid_at(10));
  token.expire_time_us = 0;
  token.revoke_time_us = 3;
  EXPECT_FALSE(token.valid_at(5));
}

TEST(ScopesTest, AreReadAndWritten) {
  EXPECT_EQ(ParseScopes("read"), 1u);
  EXPECT_EQ(ParseScopes("solve,read"), 3u);
  EXPECT_EQ(ScopeNames(7), "read,solve,admin");
  for (const char* bad : {"", "write", "read,,solve", "Read", "read,everything"}) EXPECT_FALSE(ParseScopes(bad)) << bad;
}

}  // namespace
}  // namespace rollgait::server
