#include "apps/view/page_server.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <mutex>
#include <thread>
#include <vector>

#include "apps/view/request_check.hpp"
#include "tests/support/error_message.hpp"
#include "tests/view/page_client.hpp"

namespace berth::app {
namespace {

PageFiles some_files() {
  return {{"/", {"text/html", "the page"}}, {"/page.js", {"text/javascript", "code"}}};
}

int port_of(const PageServer& server) {
  const std::string url = server.url();
  return std::atoi(url.c_str() + url.rfind(':') + 1);
}

std::size_t resident_kib() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmRSS:")) return std::strtoul(line.c_str() + 6, nullptr, 10);
  }
  return 0;
}

class PageServerTest : public ::testing::Test {
 protected:
  std::string reply(const std::string& bytes) { return bytes_back(port_, bytes); }
  int status(const std::string& bytes) { return http_status(reply(bytes)); }
  std::vector<std::string> received() {
    const std::scoped_lock lock(mutex_);
    return received_;
  }

  std::mutex mutex_;
  std::vector<std::string> received_;
  PageServer server_{{.port = 0}, some_files(), [this](const std::string& text) {
                       const std::scoped_lock lock(mutex_);
                       received_.push_back(text);
                     }};
  int port_ = port_of(server_);
};

TEST_F(PageServerTest, ServesItsFilesAndNothingElse) {
  const std::string page = reply(get_request("/"));
  EXPECT_EQ(http_status(page), 200);
  EXPECT_TRUE(page.ends_with("the page"));
  EXPECT_NE(page.find("Content-Security-Policy: default-src 'none'"), std::string::npos);
  EXPECT_EQ(status(get_request("/page.js")), 200);
  for (const char* target : {"/page", "/../page.js", "/../../etc/passwd", "//etc/passwd",
                             "/%2e%2e/etc/passwd", "/.", "/page.js/", "/etc/passwd"}) {
    EXPECT_EQ(status(get_request(target)), 404) << target;
  }
}

TEST_F(PageServerTest, RefusesOtherHosts) {
  EXPECT_EQ(status(get_request("/", "evil.com")), 403);
  EXPECT_EQ(status("GET / HTTP/1.1\r\n\r\n"), 403);
}

TEST_F(PageServerTest, RefusesWhatIsNoSuchRequest) {
  EXPECT_EQ(status("DELETE / HTTP/1.1\r\nHost: localhost\r\n\r\n"), 405);
  EXPECT_EQ(status("\x16\x03\x01 no words\r\n\r\n"), 400);
  EXPECT_EQ(status("GET / HTTP/9.9\r\n\r\n"), 400);
  EXPECT_EQ(status("GET /" + std::string(100'000, 'a') + " HTTP/1.1\r\n\r\n"), 431);
  EXPECT_EQ(
      status("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(100'000, 'a') + "\r\n\r\n"),
      431);
  EXPECT_GE(status("GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 999999999\r\n\r\nbody"),
            400);
  EXPECT_EQ(status(get_request("/socket")), 426);
  EXPECT_EQ(status(get_request("/")), 200);
}

TEST_F(PageServerTest, TakesItsOwnPagesAlone) {
  for (const char* origin :
       {"http://evil.com", "http://localhost:1", "https://localhost", "null", ""}) {
    EXPECT_EQ(status(upgrade_request("/socket", origin)), 403) << origin;
  }
  server_.publish("scene", {false, "scene"});
  EXPECT_EQ(PageClient(port_).next(), "scene");
}

TEST_F(PageServerTest, ALaterPageGetsTheNewestOfEachKindInOrder) {
  server_.publish("scene", {false, "scene 1"});
  server_.publish("image", {true, "image 1"});
  server_.publish("scene", {false, "scene 2"});
  PageClient client(port_);
  EXPECT_EQ(client.next(), "scene 2");
  EXPECT_EQ(client.next(), "image 1");
  server_.publish("image", {true, "image 2"});
  EXPECT_EQ(client.next(), "image 2");
}

TEST(PageServerOrder, IsThatInWhichKindsCameForAPageThatWasOpenBefore) {
  PageServer* server = nullptr;
  // In the server's thread, so that all of them wait when the page is told.
  PageServer own({.port = 0}, some_files(), [&](const std::string&) {
    for (const char* kind : {"scene", "mesh", "image 0", "calibration_data"}) {
      server->publish(kind, {false, kind});
    }
  });
  server = &own;
  PageClient client(port_of(own));
  client.send("now");
  for (const char* kind : {"scene", "mesh", "image 0", "calibration_data"}) {
    EXPECT_EQ(client.next(), kind);
  }
}

TEST_F(PageServerTest, TakesTextOfBoundedSize) {
  server_.publish("scene", {false, "scene"});
  PageClient client(port_);
  client.send(R"({"do": "show"})");
  while (received().empty()) std::this_thread::yield();
  EXPECT_EQ(received().front(), R"({"do": "show"})");
  EXPECT_EQ(client.next(), "scene");
  EXPECT_ANY_THROW({
    client.send(std::string(1 << 20, 'a'));
    client.next();
  });
  EXPECT_EQ(received().size(), 1u);
}

TEST_F(PageServerTest, MoreThanSixteenPagesAreRefused) {
  server_.publish("scene", {false, "scene"});
  std::vector<std::unique_ptr<PageClient>> pages;
  for (int i = 0; i < 16; ++i) pages.push_back(std::make_unique<PageClient>(port_));
  EXPECT_EQ(status(upgrade_request("/socket", "http://localhost")), 503);
  pages.clear();
  // It takes a moment until the server knows.
  std::string refused = "yes";
  for (int i = 0; i < 1000 && !refused.empty(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    refused = error_message([&] { PageClient client(port_); });
  }
  EXPECT_EQ(refused, "");
}

TEST_F(PageServerTest, AThousandRequestsAtOnceAreAllServed) {
  std::atomic<int> served = 0;
  std::vector<std::thread> users;
  for (int i = 0; i < 100; ++i) {
    users.emplace_back([&] {
      for (int k = 0; k < 10; ++k) served += status(get_request("/")) == 200 ? 1 : 0;
    });
  }
  for (std::thread& user : users) user.join();
  EXPECT_EQ(served, 1000);
}

TEST_F(PageServerTest, WhoReadsSlowlyMissesWhatWasReplacedAndTakesNoMemory) {
  constexpr std::size_t kBytes = 4 << 20;
  server_.publish("image", {true, std::string(kBytes, 'a')});
  PageClient slow(port_);
  const std::size_t before_kib = resident_kib();
  for (int i = 0; i < 500; ++i) server_.publish("image", {true, std::string(kBytes, 'b')});
  server_.publish("image", {true, "the last"});
  // Two gigabytes were published; what is held is one message each, sent and newest.
  EXPECT_LT(resident_kib(), before_kib + (64 << 10));
  int messages = 0;
  std::string newest;
  while (newest != "the last") {
    newest = slow.next();
    ++messages;
  }
  EXPECT_LT(messages, 20);
}

TEST_F(PageServerTest, MemoryDoesNotGrowWithConnections) {
  server_.publish("scene", {false, std::string(1 << 16, 's')});
  const auto visit = [&](int times) {
    for (int i = 0; i < times; ++i) {
      reply(get_request("/"));
      PageClient client(port_);
      client.next();
    }
  };
  visit(50);
  const std::size_t before_kib = resident_kib();
  visit(500);
  EXPECT_LT(resident_kib(), before_kib + (4 << 10));
}

TEST_F(PageServerTest, ATakenPortIsToldWithTheNextFreeOne) {
  const std::string message =
      error_message([&] { PageServer second({.port = port_}, {}, [](const auto&) {}); });
  expect_parts(message,
               {"port " + std::to_string(port_), "is taken", "expected a free one", "--port"});
}

TEST(PageServerAddress, IsRefusedWhereItIsNone) {
  const auto message = [](const std::string& bind) {
    return error_message([&] { PageServer server({bind, 0}, {}, [](const auto&) {}); });
  };
  expect_parts(message("nowhere"), {"--bind nowhere", "expected"});
  expect_parts(message("192.0.2.1"), {"192.0.2.1", "expected an address of this computer"});
}

TEST(PageServerAddress, AnotherOneThanLoopbackNeedsTheToken) {
  PageServer server({"0.0.0.0", 0}, some_files(), [](const auto&) {});
  const std::string url = server.url();
  const std::string token = url.substr(url.find("token=") + 6);
  EXPECT_EQ(token.size(), 32u);
  const int port = std::atoi(url.c_str() + url.find(':', 7) + 1);
  const auto status = [&](const std::string& target) {
    return http_status(bytes_back(port, get_request(target, "robot")));
  };
  EXPECT_EQ(status("/"), 403);
  EXPECT_EQ(status("/?token=" + std::string(32, '0')), 403);
  EXPECT_EQ(status("/?token=" + token), 200);
  server.publish("scene", {false, "scene"});
  EXPECT_EQ(http_status(bytes_back(port, upgrade_request("/socket", "http://localhost"))), 403);
  EXPECT_EQ(PageClient(port, "/socket?token=" + token).next(), "scene");
}

TEST(PageServerEnd, DoesNotWaitForItsPages) {
  auto server =
      std::make_unique<PageServer>(PageAddress{.port = 0}, some_files(), [](const auto&) {});
  server->publish("scene", {false, "scene"});
  PageClient client(port_of(*server));
  client.next();
  const auto start = std::chrono::steady_clock::now();
  server.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_ANY_THROW(client.next());
}

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
