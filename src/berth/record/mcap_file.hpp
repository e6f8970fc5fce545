// Inside record/ only: MCAP files (mcap.dev/spec): how they write numbers and strings, messages
// packed together as chunks, and a whole file of these.
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "berth/files/file_bytes.hpp"

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

/// What an index reports on a chunk. Offsets count from the chunk's first byte.
struct ChunkInfo {
  std::uint64_t begin_ns = 0;
  std::uint64_t end_ns = 0;
  /// Of the chunk's own record, and of the message indexes that follow it.
  std::uint64_t chunk_length = 0;
  std::uint64_t indexes_length = 0;
  std::uint64_t compressed_size = 0;
  std::uint64_t size = 0;
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  std::map<std::uint16_t, std::uint64_t> message_counts;

  std::uint64_t length() const { return chunk_length + indexes_length; }
};

/// A chunk that is being filled.
class ChunkBuilder {
 public:
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view data);
  bool is_empty() const { return index_.empty(); }
  /// Uncompressed.
  std::size_t size() const { return records_.size(); }

  /// Appends it to `out`, compressed by zstd, with its message indexes, and begins anew.
  ChunkInfo finish(std::string& out);

 private:
  std::string compressed_records() const;

  std::string records_;
  std::uint64_t begin_ns_ = 0;
  std::uint64_t end_ns_ = 0;
  /// By channel: time and offset of each message.
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index_;
  std::uint32_t sequence_ = 0;
};

struct Schema {
  std::uint16_t id = 0;
  std::string name;
  std::string encoding;
  std::string data;
};

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;
  std::string topic;
  std::string message_encoding;
};

/// A file in the file.
struct Attachment {
  std::string name;
  std::string media_type;
  std::string data;
};

/// All but messages.
struct Head {
  std::vector<Schema> schemas;
  std::vector<Channel> channels;
  std::vector<Attachment> attachments;
};

/// What stands in a file before its first chunk.
std::string beginning_of_file(const Head& head);
/// What ends a file without an index.
std::string end_without_index();

/// Writes a file with an index, so that others' programs can look into it. It appears when it is
/// finished. Throws std::runtime_error as FileInParts does.
class FileWriter {
 public:
  FileWriter(const std::filesystem::path& file, const Head& head);

  /// What follows by write() is this chunk with its indexes, in any number of parts.
  void begin_chunk(const ChunkInfo& info);
  void write(std::string_view bytes);
  void finish();

 private:
  struct PlacedChunk {
    std::uint64_t offset;
    ChunkInfo info;
  };

  void index_attachments(std::uint64_t offset);
  std::string statistics() const;
  /// Appends the group to the summary, and what says where it is.
  void add_group(Opcode opcode, const std::string& records);

  const Head& head_;
  FileInParts out_;
  std::uint64_t offset_ = 0;
  /// Of all bytes so far, up to the data's end. The specification says "in the data section"; its
  /// own programs begin with the file's first byte.
  std::uint32_t crc_ = 0;
  bool is_in_data_ = true;
  std::vector<PlacedChunk> chunks_;
  std::string attachment_indexes_;
  std::uint64_t summary_begin_ = 0;
  std::string summary_;
  std::string summary_offsets_;
};

}  // namespace berth::mcap
