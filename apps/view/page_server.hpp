// A server for one page: its files by HTTP, its messages by WebSocket.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "apps/view/page_files.hpp"
#include "apps/view/page_message.hpp"

namespace berth::app {

/// Where a page is served.
struct PageAddress {
  /// An address of this computer. With another one than loopback a random token belongs to the URL.
  std::string bind = "127.0.0.1";
  /// 0: any that is free.
  int port = 8080;
};

/// Serves from its own thread while it lives. It opens no file, takes GET alone, and bounds what
/// comes in (size, connections, time) and what waits to go out (the newest message of each kind).
class PageServer {
 public:
  /// `receive` gets each text that a page sends, in the server's thread; it has to return at once.
  /// Throws std::runtime_error where the address is none of this computer's, and where the port is
  /// taken; it names the next one that is free.
  PageServer(const PageAddress& address, PageFiles files,
             std::function<void(const std::string&)> receive);
  ~PageServer();
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;

  /// Where the page is, with the token where it needs one.
  std::string url() const;

  /// As Publish says. From any thread.
  void publish(const std::string& kind, PageMessage message);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth::app
