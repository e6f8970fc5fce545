// Inside record/ only: a whole MCAP file, written from chunks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "berth/files/file_bytes.hpp"
#include "berth/record/mcap_bytes.hpp"
#include "berth/record/mcap_chunk.hpp"

namespace berth::mcap {

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
