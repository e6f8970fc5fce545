// Which requests the page's server takes.
#pragma once

#include <string>
#include <string_view>

namespace berth::app {

/// Whether a Host header names this computer itself. A page from elsewhere whose name was made to
/// lead here (DNS rebinding) brings its own name.
bool is_loopback_host(std::string_view host);

/// Whether an Origin header is that of the page which `host` served.
bool is_own_origin(std::string_view origin, std::string_view host);

/// Compares in a time that does not tell how much of the secret is right.
bool is_same_secret(std::string_view given, std::string_view secret);

/// The value of `token` in a request's target, such as /?token=a1; empty where it has none.
std::string_view token_of(std::string_view target);

/// The target without what follows a request mark.
std::string_view path_of(std::string_view target);

/// 128 random bits as 32 letters and digits.
std::string random_token();

}  // namespace berth::app
