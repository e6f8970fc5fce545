#include "berth/record/mcap_chunk.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <stdexcept>

#include "berth/record/mcap_bytes.hpp"

namespace berth::mcap {

std::uint32_t crc32(std::string_view bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

void ChunkBuilder::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
  begin_ns_ = is_empty() ? time_ns : std::min(begin_ns_, time_ns);
  end_ns_ = is_empty() ? time_ns : std::max(end_ns_, time_ns);
  index_[channel].emplace_back(time_ns, records_.size());
  constexpr std::size_t kFixed = 2 + 4 + 8 + 8;
  put(records_, static_cast<std::uint8_t>(Opcode::message));
  put(records_, static_cast<std::uint64_t>(kFixed + data.size()));
  put(records_, channel);
  put(records_, sequence_++);
  put(records_, time_ns);
  put(records_, time_ns);
  records_ += data;
}

std::string ChunkBuilder::compressed_records() const {
  // Depth images take a third or less; a higher level takes twice the time for a tenth of that.
  constexpr int kLevel = 1;
  std::string out(ZSTD_compressBound(records_.size()), '\0');
  const std::size_t size =
      ZSTD_compress(out.data(), out.size(), records_.data(), records_.size(), kLevel);
  if (ZSTD_isError(size) != 0) throw std::runtime_error(ZSTD_getErrorName(size));
  out.resize(size);
  return out;
}

ChunkInfo ChunkBuilder::finish(std::string& out) {
  const std::string compressed = compressed_records();
  ChunkInfo info;
  info.begin_ns = begin_ns_;
  info.end_ns = end_ns_;
  info.compressed_size = compressed.size();
  info.size = records_.size();
  const std::size_t begin = out.size();
  std::string head;
  put(head, begin_ns_);
  put(head, end_ns_);
  put(head, static_cast<std::uint64_t>(records_.size()));
  put(head, crc32(records_));
  put(head, std::string_view("zstd"));
  put(head, static_cast<std::uint64_t>(compressed.size()));
  put(out, static_cast<std::uint8_t>(Opcode::chunk));
  put(out, static_cast<std::uint64_t>(head.size() + compressed.size()));
  out += head;
  out += compressed;
  info.chunk_length = out.size() - begin;
  for (const auto& [channel, messages] : index_) {
    info.index_offsets[channel] = out.size() - begin;
    info.message_counts[channel] = messages.size();
    std::string index;
    put(index, channel);
    put(index, static_cast<std::uint32_t>(16 * messages.size()));
    for (const auto& [time_ns, offset] : messages) {
      put(index, time_ns);
      put(index, offset);
    }
    put_record(out, Opcode::message_index, index);
  }
  info.indexes_length = out.size() - begin - info.chunk_length;
  records_.clear();
  index_.clear();
  return info;
}

}  // namespace berth::mcap
