#include "apps/view/request_check.hpp"

#include <fmt/format.h>

#include <random>

namespace berth::app {

bool is_loopback_host(std::string_view host) {
  const std::size_t port = host.rfind(':');
  const bool has_port =
      port != std::string_view::npos && host.find(']', port) == std::string_view::npos;
  const std::string_view name = has_port ? host.substr(0, port) : host;
  return name == "localhost" || name == "127.0.0.1" || name == "[::1]";
}

bool is_own_origin(std::string_view origin, std::string_view host) {
  constexpr std::string_view kScheme = "http://";
  return !host.empty() && origin.starts_with(kScheme) && origin.substr(kScheme.size()) == host;
}

bool is_same_secret(std::string_view given, std::string_view secret) {
  unsigned difference = given.size() == secret.size() ? 0 : 1;
  for (std::size_t i = 0; i < secret.size(); ++i) {
    const char one = i < given.size() ? given[i] : '\0';
    difference |= static_cast<unsigned char>(one ^ secret[i]);
  }
  return difference == 0;
}

std::string_view token_of(std::string_view target) {
  constexpr std::string_view kKey = "token=";
  for (std::size_t at = target.find('?'); at != std::string_view::npos; at = target.find('&', at)) {
    ++at;
    if (!target.substr(at).starts_with(kKey)) continue;
    at += kKey.size();
    return target.substr(at, target.find('&', at) - at);
  }
  return {};
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

std::string random_token() {
  // The kernel's random numbers, with this library.
  std::random_device device;
  std::string token;
  for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", device());
  return token;
}

}  // namespace berth::app
