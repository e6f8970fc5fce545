// Inside record/ only: how MCAP files write numbers and strings (mcap.dev/spec).
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace berth::mcap {

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};
/// Opcode and length before each record's content.
inline constexpr std::size_t kRecordHead = 9;

/// Appends a number, the least byte first.
template <class Number>
requires std::is_integral_v<Number>
void put(std::string& out, Number value) {
  auto rest = static_cast<std::make_unsigned_t<Number>>(value);
  for (std::size_t i = 0; i < sizeof rest; ++i) {
    out.push_back(static_cast<char>(rest & 0xFF));
    if constexpr (sizeof rest > 1) rest >>= 8;
  }
}

/// Appends a string with its length of 4 bytes before it.
inline void put(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

inline void put_record(std::string& out, Opcode opcode, std::string_view content) {
  put(out, static_cast<std::uint8_t>(opcode));
  put(out, static_cast<std::uint64_t>(content.size()));
  out += content;
}

/// CRC-32 of all bytes, going on from that of those before.
std::uint32_t crc32(std::string_view bytes, std::uint32_t before = 0);

}  // namespace berth::mcap
