#include "tests/view/page_client.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <cstdlib>
#include <stdexcept>

namespace berth {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

tcp::endpoint loopback(int port) {
  return {asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)};
}

}  // namespace

std::string bytes_back(int port, const std::string& request) {
  asio::io_context io;
  tcp::socket socket(io);
  beast::error_code error;
  socket.connect(loopback(port), error);
  if (error) return "";
  asio::write(socket, asio::buffer(request), error);
  std::string reply;
  asio::read(socket, asio::dynamic_buffer(reply), error);
  return reply;
}

std::string get_request(const std::string& target, const std::string& host) {
  return "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
}

std::string upgrade_request(const std::string& target, const std::string& origin) {
  return "GET " + target +
         " HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         (origin.empty() ? "" : "Origin: " + origin + "\r\n") + "\r\n";
}

int http_status(const std::string& reply) {
  return reply.starts_with("HTTP/1.1 ") ? std::atoi(reply.c_str() + 9) : 0;
}

struct PageClient::State {
  asio::io_context io;
  websocket::stream<tcp::socket> socket{io};
};

PageClient::PageClient(int port, const std::string& target, const std::string& origin)
    : state_(std::make_unique<State>()) {
  state_->socket.next_layer().connect(loopback(port));
  state_->socket.read_message_max(0);
  state_->socket.set_option(
      websocket::stream_base::decorator([origin](websocket::request_type& request) {
        request.set(beast::http::field::origin, origin);
      }));
  beast::error_code error;
  state_->socket.handshake("localhost", target, error);
  if (error) throw std::runtime_error("refused");
}

PageClient::~PageClient() = default;

void PageClient::send(const std::string& text) { state_->socket.write(asio::buffer(text)); }

std::string PageClient::next() {
  beast::flat_buffer buffer;
  state_->socket.read(buffer);
  return beast::buffers_to_string(buffer.data());
}

}  // namespace berth
