#include "apps/view/page_message.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace berth::app {

PageMessage json_message(const nlohmann::ordered_json& json) { return {false, json.dump()}; }

PageMessage binary_message(const nlohmann::ordered_json& header,
                           const std::vector<std::span<const std::byte>>& arrays) {
  std::string text = header.dump();
  while ((text.size() + sizeof(std::uint32_t)) % 8 != 0) text += ' ';
  const auto length = static_cast<std::uint32_t>(text.size());
  std::array<char, sizeof length> prefix;
  std::memcpy(prefix.data(), &length, sizeof length);
  PageMessage message{true, std::string(prefix.data(), prefix.size()) + text};
  for (const std::span<const std::byte> array : arrays) {
    message.bytes.append(reinterpret_cast<const char*>(array.data()), array.size());
    while (message.bytes.size() % 4 != 0) message.bytes += '\0';
  }
  return message;
}

}  // namespace berth::app
