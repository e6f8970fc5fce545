// A client of the page's server that does what browsers do, and what they do not.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace berth {

/// What came back to these bytes at 127.0.0.1:port, up to the end of the connection; empty where
/// there was no connection.
std::string bytes_back(int port, const std::string& request);

/// A GET as a browser writes it.
std::string get_request(const std::string& target, const std::string& host = "localhost");

/// A request for a WebSocket; without an Origin where that is empty.
std::string upgrade_request(const std::string& target, const std::string& origin);

/// The number in the first line of a reply; 0 where there is none.
int http_status(const std::string& reply);

/// A WebSocket to the server.
class PageClient {
 public:
  /// Throws std::runtime_error where it is refused.
  explicit PageClient(int port, const std::string& target = "/socket",
                      const std::string& origin = "http://localhost");
  ~PageClient();

  void send(const std::string& text);
  /// The next message. Throws where the server ends the connection.
  std::string next();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth
