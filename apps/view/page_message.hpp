// What goes from the program to its pages.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

namespace berth::app {

/// One message: JSON text; or bytes, which are the length of a header (32 bits, little endian), the
/// header (JSON, filled up by blanks to a multiple of eight with the length) and numbers.
struct PageMessage {
  bool is_binary = false;
  std::string bytes;
};

/// Takes a message to all pages. Of each kind a page gets the newest alone, later pages too: who
/// reads slowly misses what was replaced meanwhile.
using Publish = std::function<void(const std::string& kind, PageMessage message)>;

PageMessage json_message(const nlohmann::ordered_json& json);

/// `arrays` come one after another behind the header, each from a multiple of four bytes on.
PageMessage binary_message(const nlohmann::ordered_json& header,
                           const std::vector<std::span<const std::byte>>& arrays);

}  // namespace berth::app
