// Inside record/ only: reads MCAP files that FileWriter wrote, or another program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "berth/record/mcap_file.hpp"

namespace berth::mcap {

/// One message; `data` is valid until the next one.
struct Message {
  std::uint16_t channel = 0;
  std::uint64_t time_ns = 0;
  std::string_view data;
};

/// The whole file is looked through when it is opened, and its checksum is compared where it has
/// one. A file that is cut off, as by a crash, gives the messages that it has, and then next()
/// throws. Chunks may be compressed by zstd, or not at all. Throws std::runtime_error with file,
/// place, what is wrong and what was expected.
class FileReader {
 public:
  explicit FileReader(std::filesystem::path file);

  const Head& head() const { return head_; }
  /// Throws where there is none of this name.
  const Attachment& attachment(std::string_view name) const;

  /// The next message in the file's order; false at the end of a whole file.
  bool next(Message& out);

  /// Throws what is thrown of this file.
  [[noreturn]] void fail(std::string_view what, std::string_view expected) const;
  /// The same with an error's text, which may tell what was expected.
  [[noreturn]] void fail_with(std::string_view place, std::string_view error) const;

 private:
  struct Place {
    std::uint64_t offset;
    std::uint64_t length;
  };

  void look_through();
  /// Whether the file ends within the next `count` bytes.
  bool is_cut_within(std::uint64_t count);
  /// Reads the opcode and length of the record at `offset_`.
  std::uint64_t begin_record(std::uint8_t& opcode);
  std::string read_bytes(std::uint64_t count);
  void take_record(std::uint8_t opcode, std::string content);
  void take_attachment(std::string_view content);
  void take_chunk(const Place& place, std::string_view content, std::string& records) const;
  bool load_next_chunk();

  std::filesystem::path file_;
  std::ifstream in_;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;
  /// Where the file is cut off; empty: it is whole.
  std::string cut_;
  Head head_;
  /// The contents of chunks.
  std::vector<Place> chunks_;
  std::size_t next_chunk_ = 0;
  std::string records_;
  std::size_t at_ = 0;
};

}  // namespace berth::mcap
