#include "apps/view/request_check.hpp"

#include <gtest/gtest.h>

namespace berth::app {
namespace {

TEST(RequestCheck, KnowsNamesOfThisComputer) {
  for (const char* host :
       {"localhost", "localhost:8080", "127.0.0.1:8080", "127.0.0.1", "[::1]", "[::1]:9"}) {
    EXPECT_TRUE(is_loopback_host(host)) << host;
  }
  for (const char* host : {"", "evil.com", "localhost.evil.com", "127.0.0.1.evil.com:8080",
                           "evil.com:127", "::1", "127.0.0.2"}) {
    EXPECT_FALSE(is_loopback_host(host)) << host;
  }
}

TEST(RequestCheck, KnowsItsOwnPage) {
  EXPECT_TRUE(is_own_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://localhost:8081", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://evil.com", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("null", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://", ""));
}

TEST(RequestCheck, ComparesSecrets) {
  EXPECT_TRUE(is_same_secret("abc", "abc"));
  for (const char* given : {"", "ab", "abd", "abcd", "ABC"})
    EXPECT_FALSE(is_same_secret(given, "abc"));
}

TEST(RequestCheck, FindsPathAndToken) {
  EXPECT_EQ(token_of("/?token=a1"), "a1");
  EXPECT_EQ(token_of("/socket?x=2&token=a1&y=3"), "a1");
  EXPECT_EQ(token_of("/?nottoken=a1"), "");
  EXPECT_EQ(token_of("/token=a1"), "");
  EXPECT_EQ(path_of("/socket?token=a1"), "/socket");
  EXPECT_EQ(path_of("/"), "/");
}

TEST(RequestCheck, TokensDiffer) {
  EXPECT_EQ(random_token().size(), 32u);
  EXPECT_NE(random_token(), random_token());
}

}  // namespace
}  // namespace berth::app
