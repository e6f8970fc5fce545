#pragma once

#include <string>
#include <string_view>

namespace berth::app {

/// The text as HTML and its attributes show it: with < > & " ' escaped.
std::string html_text(std::string_view text);

}  // namespace berth::app
