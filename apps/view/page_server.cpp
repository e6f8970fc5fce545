#include "apps/view/page_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "apps/view/request_check.hpp"

namespace berth::app {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using std::chrono::seconds;

/// More wait in the system's queue.
constexpr std::size_t kMostConnections = 64;
constexpr std::size_t kMostPages = 16;
constexpr std::uint32_t kMostHeaderBytes = 8 << 10;
constexpr std::size_t kMostMessageBytes = 64 << 10;
/// For a request to come and its reply to go, and for a message to a page.
constexpr seconds kLongestTransfer{20};
constexpr seconds kLongestSilence{60};

constexpr const char* kContentSecurityPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

using Request = http::request<http::empty_body>;
using Response = http::response<http::string_body>;

std::string_view view_of(beast::string_view text) { return {text.data(), text.size()}; }

Response response_of(http::status status, std::string_view media_type, std::string bytes) {
  Response response{status, 11};
  response.set(http::field::content_type, beast::string_view(media_type.data(), media_type.size()));
  response.set("Content-Security-Policy", kContentSecurityPolicy);
  response.set("X-Content-Type-Options", "nosniff");
  response.set(http::field::cache_control, "no-store");
  response.set("Referrer-Policy", "no-referrer");
  response.keep_alive(false);
  response.body() = std::move(bytes);
  response.prepare_payload();
  return response;
}

Response refusal_of(http::status status, const std::string& why) {
  return response_of(status, "text/plain; charset=utf-8", why + "\n");
}

class PageConnection;

/// What all connections share; all of it but `latest` belongs to the server's thread.
struct ServerState {
  PageFiles files;
  std::function<void(const std::string&)> receive;
  bool is_loopback = true;
  /// Empty: none is needed.
  std::string token;
  std::size_t connections = 0;
  bool is_full = false;
  std::set<PageConnection*> pages;

  using Latest = std::vector<std::pair<std::string, std::shared_ptr<const PageMessage>>>;
  std::mutex mutex;
  /// By kind, in the order in which kinds came first.
  Latest latest;
  std::set<std::string> fresh;

  // Last, so that they go first: what waits in them are connections, which know all the rest.
  bool is_ending = false;
  asio::io_context io{1};
  tcp::acceptor acceptor{io};

  std::shared_ptr<const PageMessage> latest_of(const std::string& kind) {
    const std::scoped_lock lock(mutex);
    const auto at = std::find_if(latest.begin(), latest.end(),
                                 [&](const auto& one) { return one.first == kind; });
    return at->second;
  }
  std::vector<std::string> all_kinds() {
    const std::scoped_lock lock(mutex);
    std::vector<std::string> kinds;
    for (const auto& one : latest) kinds.push_back(one.first);
    return kinds;
  }
  void accept();
  void tell_pages();
};

/// One request; where it asks for the socket, a page from then on.
class PageConnection : public std::enable_shared_from_this<PageConnection> {
 public:
  PageConnection(ServerState& server, tcp::socket socket)
      : server_(server), stream_(std::move(socket)), timer_(server.io) {}
  ~PageConnection() {
    server_.pages.erase(this);
    --server_.connections;
    if (!server_.is_ending && std::exchange(server_.is_full, false)) server_.accept();
  }

  void start() {
    parser_.header_limit(kMostHeaderBytes);
    parser_.body_limit(0);
    stream_.expires_after(kLongestTransfer);
    http::async_read(
        stream_, buffer_, parser_,
        [self = shared_from_this()](beast::error_code error, std::size_t) { self->handle(error); });
  }

  /// Sends the newest message of this kind as soon as the page takes it.
  void tell(const std::string& kind) {
    if (std::find(waiting_.begin(), waiting_.end(), kind) == waiting_.end()) {
      waiting_.push_back(kind);
    }
    send_next();
  }

 private:
  void handle(beast::error_code error) {
    if (error == http::error::header_limit) {
      return reply(refusal_of(http::status::request_header_fields_too_large, "too long a request"));
    }
    if (error == http::error::body_limit) {
      return reply(refusal_of(http::status::payload_too_large, "expected GET without a body"));
    }
    if (error.category() == make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream) {
      return reply(refusal_of(http::status::bad_request, "no HTTP request"));
    }
    if (error) return;
    const Request& request = parser_.get();
    const std::string_view host = view_of(request[http::field::host]);
    const std::string_view target = view_of(request.target());
    if (server_.is_loopback && !is_loopback_host(host)) {
      return reply(refusal_of(http::status::forbidden, "expected localhost as the host"));
    }
    if (request.method() != http::verb::get) {
      return reply(refusal_of(http::status::method_not_allowed, "expected GET"));
    }
    const bool is_secret = path_of(target) == "/" || path_of(target) == "/socket";
    if (is_secret && !server_.token.empty() && !is_same_secret(token_of(target), server_.token)) {
      return reply(refusal_of(http::status::forbidden,
                              "expected the whole address that berth printed, with its token"));
    }
    if (path_of(target) == "/socket") return open_page(request, host);
    const auto file = server_.files.find(path_of(target));
    if (file == server_.files.end()) {
      return reply(refusal_of(http::status::not_found, "nothing is here; the page is at /"));
    }
    reply(response_of(http::status::ok, file->second.media_type, file->second.bytes));
  }

  void reply(Response response) {
    response_ = std::move(response);
    stream_.expires_after(kLongestTransfer);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code, std::size_t) {
                        beast::error_code ignored;
                        self->stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
                      });
  }

  void open_page(const Request& request, std::string_view host) {
    if (!websocket::is_upgrade(request)) {
      return reply(refusal_of(http::status::upgrade_required, "expected a WebSocket"));
    }
    if (!is_own_origin(view_of(request[http::field::origin]), host)) {
      return reply(refusal_of(http::status::forbidden, "expected a page of this server"));
    }
    if (server_.pages.size() >= kMostPages) {
      return reply(refusal_of(http::status::service_unavailable, "too many pages are open"));
    }
    socket_.emplace(std::move(stream_));
    beast::get_lowest_layer(*socket_).expires_never();
    socket_->set_option(websocket::stream_base::timeout{kLongestTransfer, kLongestSilence, true});
    socket_->read_message_max(kMostMessageBytes);
    server_.pages.insert(this);
    socket_->async_accept(request, [self = shared_from_this()](beast::error_code error) {
      if (error) return;
      self->is_open_ = true;
      for (const std::string& kind : self->server_.all_kinds()) self->tell(kind);
      self->read_next();
    });
  }

  void read_next() {
    socket_->async_read(buffer_, [self = shared_from_this()](beast::error_code error, std::size_t) {
      // The page went away, or sent what no page sends: its timer and its writes end with the
      // socket.
      if (error) return self->end();
      if (self->socket_->got_text()) {
        self->server_.receive(beast::buffers_to_string(self->buffer_.data()));
      }
      self->buffer_.consume(self->buffer_.size());
      self->read_next();
    });
  }

  void send_next() {
    if (!is_open_ || sending_ || waiting_.empty()) return;
    sending_ = server_.latest_of(waiting_.front());
    waiting_.pop_front();
    socket_->binary(sending_->is_binary);
    timer_.expires_after(kLongestTransfer);
    timer_.async_wait([weak = weak_from_this()](beast::error_code error) {
      const auto self = weak.lock();
      if (!error && self) self->end();
    });
    socket_->async_write(asio::buffer(sending_->bytes),
                         [self = shared_from_this()](beast::error_code error, std::size_t) {
                           self->timer_.cancel();
                           self->sending_.reset();
                           if (error) return self->end();
                           self->send_next();
                         });
  }

  void end() {
    is_open_ = false;
    beast::get_lowest_layer(*socket_).close();
  }

  ServerState& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  Response response_;
  std::optional<websocket::stream<beast::tcp_stream>> socket_;
  bool is_open_ = false;
  asio::steady_timer timer_;
  std::deque<std::string> waiting_;
  std::shared_ptr<const PageMessage> sending_;
};

void ServerState::accept() {
  if (connections >= kMostConnections) {
    is_full = true;
    return;
  }
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error) {
      ++connections;
      std::make_shared<PageConnection>(*this, std::move(socket))->start();
    }
    accept();
  });
}

void ServerState::tell_pages() {
  std::vector<std::string> kinds;
  {
    const std::scoped_lock lock(mutex);
    for (const auto& one : latest) {
      if (fresh.contains(one.first)) kinds.push_back(one.first);
    }
    fresh.clear();
  }
  for (PageConnection* page : pages) {
    for (const std::string& kind : kinds) page->tell(kind);
  }
}

/// Listens there; false where the port is taken.
bool listen_at(tcp::acceptor& acceptor, const tcp::endpoint& endpoint) {
  acceptor.open(endpoint.protocol());
  acceptor.set_option(asio::socket_base::reuse_address(true));
  beast::error_code error;
  acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (!error) return true;
  acceptor.close();
  if (error == asio::error::address_in_use) return false;
  throw std::runtime_error(
      fmt::format("{}:{}: cannot be served: {}; expected an address of this "
                  "computer and a port that its user may open",
                  endpoint.address().to_string(), endpoint.port(), error.message()));
}

/// After one that is taken.
int next_free_port(asio::io_context& io, const asio::ip::address& bind, int port) {
  constexpr int kLastPort = 65535;
  while (++port <= kLastPort) {
    tcp::acceptor trial(io);
    if (listen_at(trial, {bind, static_cast<std::uint16_t>(port)})) return port;
  }
  return 0;
}

asio::ip::address address_of(const std::string& bind) {
  beast::error_code error;
  const asio::ip::address address = asio::ip::make_address(bind, error);
  if (!error) return address;
  throw std::runtime_error(
      fmt::format("--bind {}: is no address; expected one such as 127.0.0.1 or 0.0.0.0", bind));
}

std::string url_of(const tcp::endpoint& at, const std::string& token) {
  const std::string address = at.address().to_string();
  return fmt::format("http://{}:{}/{}", at.address().is_v6() ? "[" + address + "]" : address,
                     at.port(), token.empty() ? "" : "?token=" + token);
}

}  // namespace

struct PageServer::State : ServerState {
  std::string url;
  std::thread thread;
};

PageServer::PageServer(const PageAddress& address, PageFiles files,
                       std::function<void(const std::string&)> receive)
    : state_(std::make_unique<State>()) {
  const asio::ip::address bind = address_of(address.bind);
  if (!listen_at(state_->acceptor, {bind, static_cast<std::uint16_t>(address.port)})) {
    const int free_port = next_free_port(state_->io, bind, address.port);
    throw std::runtime_error(
        fmt::format("port {} of {} is taken; expected a free one, such as "
                    "--port {}",
                    address.port, address.bind, free_port));
  }
  state_->files = std::move(files);
  state_->receive = std::move(receive);
  state_->is_loopback = bind.is_loopback();
  if (!state_->is_loopback) state_->token = random_token();
  state_->url = url_of(state_->acceptor.local_endpoint(), state_->token);
  state_->accept();
  state_->thread = std::thread([this] { state_->io.run(); });
}

PageServer::~PageServer() {
  state_->io.stop();
  state_->thread.join();
  state_->is_ending = true;
}

std::string PageServer::url() const { return state_->url; }

void PageServer::publish(const std::string& kind, PageMessage message) {
  const auto shared = std::make_shared<const PageMessage>(std::move(message));
  bool is_first = false;
  {
    const std::scoped_lock lock(state_->mutex);
    auto& latest = state_->latest;
    const auto at = std::find_if(latest.begin(), latest.end(),
                                 [&](const auto& one) { return one.first == kind; });
    if (at == latest.end()) {
      latest.emplace_back(kind, shared);
    } else {
      at->second = shared;
    }
    is_first = state_->fresh.empty();
    state_->fresh.insert(kind);
  }
  if (is_first) asio::post(state_->io, [this] { state_->tell_pages(); });
}

}  // namespace berth::app
