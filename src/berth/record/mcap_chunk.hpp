// Inside record/ only: messages packed together, as MCAP files hold them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace berth::mcap {

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

}  // namespace berth::mcap
