#include "berth/record/mcap_file.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <map>
#include <stdexcept>

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

namespace {

std::string schemas_of(const Head& head) {
  std::string out;
  for (const Schema& schema : head.schemas) {
    std::string content;
    put(content, schema.id);
    put(content, std::string_view(schema.name));
    put(content, std::string_view(schema.encoding));
    put(content, std::string_view(schema.data));
    put_record(out, Opcode::schema, content);
  }
  return out;
}

std::string channels_of(const Head& head) {
  std::string out;
  for (const Channel& channel : head.channels) {
    std::string content;
    put(content, channel.id);
    put(content, channel.schema_id);
    put(content, std::string_view(channel.topic));
    put(content, std::string_view(channel.message_encoding));
    put(content, std::uint32_t{0});  // no metadata
    put_record(out, Opcode::channel, content);
  }
  return out;
}

/// Magic, header, schemas and channels.
std::string head_records(const Head& head) {
  std::string header;
  put(header, std::string_view());
  put(header, std::string_view("berth"));
  std::string out(kMagic);
  put_record(out, Opcode::header, header);
  return out + schemas_of(head) + channels_of(head);
}

constexpr std::uint64_t kNoTime = 0;

std::string record_of(const Attachment& attachment) {
  std::string content;
  put(content, kNoTime);
  put(content, kNoTime);
  put(content, std::string_view(attachment.name));
  put(content, std::string_view(attachment.media_type));
  put(content, static_cast<std::uint64_t>(attachment.data.size()));
  content += attachment.data;
  put(content, crc32(content));
  std::string record;
  put_record(record, Opcode::attachment, content);
  return record;
}

/// Where the summary and what reports on its parts begin; 0: there is none.
std::string footer(std::uint64_t summary_begin, std::uint64_t offsets_begin) {
  constexpr std::uint64_t kSize = 8 + 8 + 4;
  std::string out;
  put(out, static_cast<std::uint8_t>(Opcode::footer));
  put(out, kSize);
  put(out, summary_begin);
  put(out, offsets_begin);
  return out;
}

std::string data_end(std::uint32_t crc) {
  std::string content, record;
  put(content, crc);
  put_record(record, Opcode::data_end, content);
  return record;
}

/// A map of numbers, with its length in bytes before it.
void put_map(std::string& out, const std::map<std::uint16_t, std::uint64_t>& map,
             std::uint64_t added = 0) {
  put(out, static_cast<std::uint32_t>(10 * map.size()));
  for (const auto& [key, value] : map) {
    put(out, key);
    put(out, value + added);
  }
}

}  // namespace

std::string beginning_of_file(const Head& head) {
  std::string out = head_records(head);
  for (const Attachment& attachment : head.attachments) out += record_of(attachment);
  return out;
}

std::string end_without_index() {
  std::string out = data_end(0) + footer(0, 0);
  put(out, std::uint32_t{0});  // no checksum
  out += kMagic;
  return out;
}

FileWriter::FileWriter(const std::filesystem::path& file, const Head& head)
    : head_(head), out_(file) {
  write(beginning_of_file(head));
  index_attachments(head_records(head).size());
}

void FileWriter::write(std::string_view bytes) {
  out_.write(bytes);
  offset_ += bytes.size();
  if (is_in_data_) crc_ = crc32(bytes, crc_);
}

void FileWriter::index_attachments(std::uint64_t offset) {
  for (const Attachment& attachment : head_.attachments) {
    const std::uint64_t length = record_of(attachment).size();
    std::string index;
    put(index, offset);
    put(index, length);
    put(index, kNoTime);
    put(index, kNoTime);
    put(index, static_cast<std::uint64_t>(attachment.data.size()));
    put(index, std::string_view(attachment.name));
    put(index, std::string_view(attachment.media_type));
    put_record(attachment_indexes_, Opcode::attachment_index, index);
    offset += length;
  }
}

void FileWriter::begin_chunk(const ChunkInfo& info) { chunks_.push_back({offset_, info}); }

std::string FileWriter::statistics() const {
  std::uint64_t begin_ns = chunks_.empty() ? 0 : chunks_.front().info.begin_ns;
  std::uint64_t end_ns = 0, messages = 0;
  std::map<std::uint16_t, std::uint64_t> counts;
  for (const PlacedChunk& chunk : chunks_) {
    begin_ns = std::min(begin_ns, chunk.info.begin_ns);
    end_ns = std::max(end_ns, chunk.info.end_ns);
    for (const auto& [channel, count] : chunk.info.message_counts) {
      counts[channel] += count;
      messages += count;
    }
  }
  std::string content, out;
  put(content, messages);
  put(content, static_cast<std::uint16_t>(head_.schemas.size()));
  put(content, static_cast<std::uint32_t>(head_.channels.size()));
  put(content, static_cast<std::uint32_t>(head_.attachments.size()));
  put(content, std::uint32_t{0});  // no metadata
  put(content, static_cast<std::uint32_t>(chunks_.size()));
  put(content, begin_ns);
  put(content, end_ns);
  put_map(content, counts);
  put_record(out, Opcode::statistics, content);
  return out;
}

void FileWriter::add_group(Opcode opcode, const std::string& records) {
  if (records.empty()) return;
  std::string content;
  put(content, static_cast<std::uint8_t>(opcode));
  put(content, summary_begin_ + summary_.size());
  put(content, static_cast<std::uint64_t>(records.size()));
  put_record(summary_offsets_, Opcode::summary_offset, content);
  summary_ += records;
}

void FileWriter::finish() {
  std::string chunk_indexes;
  for (const auto& [offset, info] : chunks_) {
    std::string content;
    put(content, info.begin_ns);
    put(content, info.end_ns);
    put(content, offset);
    put(content, info.chunk_length);
    put_map(content, info.index_offsets, offset);
    put(content, info.indexes_length);
    put(content, std::string_view("zstd"));
    put(content, info.compressed_size);
    put(content, info.size);
    put_record(chunk_indexes, Opcode::chunk_index, content);
  }
  is_in_data_ = false;
  write(data_end(crc_));
  summary_begin_ = offset_;
  add_group(Opcode::schema, schemas_of(head_));
  add_group(Opcode::channel, channels_of(head_));
  add_group(Opcode::statistics, statistics());
  add_group(Opcode::chunk_index, chunk_indexes);
  add_group(Opcode::attachment_index, attachment_indexes_);
  std::string end = summary_ + summary_offsets_;
  end += footer(summary_begin_, summary_begin_ + summary_.size());
  put(end, crc32(end));
  end += kMagic;
  write(end);
  out_.keep();
}

}  // namespace berth::mcap
