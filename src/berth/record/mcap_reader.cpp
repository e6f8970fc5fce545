#include "berth/record/mcap_reader.hpp"

#include <fmt/format.h>
#include <zstd.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "berth/files/error.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/record/mcap_file.hpp"

namespace berth::mcap {
namespace {

/// Above what a recorder packs together, or attaches.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
/// Two MiB and one image: what a few bytes may claim to unpack to.
constexpr std::uint64_t kMostUnpackedBytes = std::uint64_t{256} << 20;

/// Takes a record's content apart.
class Fields {
 public:
  Fields(const FileReader& file, std::string_view content) : file_(file), rest_(content) {}

  template <class Number>
  Number number() {
    const std::string_view bytes = take(sizeof(Number));
    Number value = 0;
    for (std::size_t i = sizeof(Number); i-- > 0;) {
      value = static_cast<Number>(static_cast<std::uint64_t>(value) << 8 |
                                  static_cast<unsigned char>(bytes[i]));
    }
    return value;
  }
  std::string_view text() { return take(number<std::uint32_t>()); }
  std::string_view take(std::uint64_t count) {
    if (count > rest_.size()) {
      file_.fail(fmt::format("damaged: a record's part of {} bytes, where {} are left", count,
                             rest_.size()),
                 "a recording as it was written");
    }
    const std::string_view bytes = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return bytes;
  }
  std::string_view rest() const { return rest_; }

 private:
  const FileReader& file_;
  std::string_view rest_;
};

/// One that is told twice is the same.
template <class Described>
void add_once(Described one, std::vector<Described>& all) {
  const auto same = [&](const Described& other) { return other.id == one.id; };
  if (std::ranges::none_of(all, same)) all.push_back(std::move(one));
}

}  // namespace

FileReader::FileReader(std::filesystem::path file) : file_(std::move(file)) {
  // Where it is missing or no file, this says so. Many images may take more than one GiB.
  constexpr std::uintmax_t kAnySize = std::numeric_limits<std::uintmax_t>::max();
  const FileEnds ends = read_file_ends(file_, kMagic.size(), kAnySize);
  if (!ends.first.empty() && !kMagic.starts_with(ends.first)) {
    fail("does not begin as an MCAP file does", "a recording in MCAP");
  }
  size_ = std::filesystem::file_size(file_);
  in_.open(file_, std::ios::binary);
  look_through();
  if (cut_.empty() && ends.last != kMagic) {
    cut_ = fmt::format("cut off: byte {}: its index ends here", size_);
  }
  if (!cut_.empty() && chunks_.empty()) fail(cut_, "all of it");
}

void FileReader::fail(std::string_view what, std::string_view expected) const {
  throw_bad_file({file_}, what, expected);
}

void FileReader::fail_with(std::string_view place, std::string_view error) const {
  constexpr std::string_view kExpected = "; expected ";
  const std::size_t at = error.find(kExpected);
  fail(fmt::format("{}: {}", place, error.substr(0, at)),
       at == std::string_view::npos ? "what berth recorded" : error.substr(at + kExpected.size()));
}

const Attachment& FileReader::attachment(std::string_view name) const {
  const auto found = std::ranges::find(head_.attachments, name, &Attachment::name);
  if (found != head_.attachments.end()) return *found;
  fail(fmt::format("attachment {}: missing", name), "a recording that berth made");
}

std::string FileReader::read_bytes(std::uint64_t count) {
  if (count > kMostBytes) {
    fail(fmt::format("byte {}: a record of {} bytes", offset_, count), "at most 1 GiB");
  }
  std::string bytes(count, '\0');
  if (!in_.read(bytes.data(), static_cast<std::streamsize>(count))) {
    fail(fmt::format("byte {}: cannot be read", offset_), "a file on a disk that works");
  }
  offset_ += count;
  return bytes;
}

std::uint64_t FileReader::begin_record(std::uint8_t& opcode) {
  const std::string head = read_bytes(kRecordHead);
  if (opcode = static_cast<std::uint8_t>(head[0]);
      static_cast<Opcode>(opcode) != Opcode::data_end) {
    crc_ = crc32(head, crc_);
  }
  return Fields(*this, std::string_view(head).substr(1)).number<std::uint64_t>();
}

bool FileReader::is_cut_within(std::uint64_t count) {
  if (count <= size_ - offset_) return false;
  cut_ = fmt::format("cut off: byte {}: {} bytes should follow, and {} do", offset_, count,
                     size_ - offset_);
  return true;
}

void FileReader::look_through() {
  if (is_cut_within(kMagic.size())) return;
  crc_ = crc32(read_bytes(kMagic.size()));
  std::uint8_t opcode = 0;
  while (!is_cut_within(kRecordHead)) {
    const std::uint64_t length = begin_record(opcode);
    const std::uint64_t begin = offset_;
    if (opcode == 0) {
      // What a disk that lost its power may leave.
      cut_ = fmt::format("cut off: byte {}: nothing was written from here on", begin - kRecordHead);
      return;
    }
    if (is_cut_within(length)) return;
    std::string content = read_bytes(length);
    if (static_cast<Opcode>(opcode) == Opcode::data_end) {
      const auto crc = Fields(*this, content).number<std::uint32_t>();
      if (crc != 0 && crc != crc_) {
        fail(fmt::format("damaged: byte {}: the checksum of all before it differs", begin),
             "a recording as it was written");
      }
      return;
    }
    crc_ = crc32(content, crc_);
    if (static_cast<Opcode>(opcode) == Opcode::footer) {
      fail(fmt::format("damaged: byte {}: a footer before the data's end", begin), "none there");
    }
    if (static_cast<Opcode>(opcode) == Opcode::chunk) {
      chunks_.push_back({begin, length});
    } else {
      take_record(opcode, std::move(content));
    }
  }
}

void FileReader::take_record(std::uint8_t opcode, std::string content) {
  Fields fields(*this, content);
  if (static_cast<Opcode>(opcode) == Opcode::schema) {
    Schema schema;
    schema.id = fields.number<std::uint16_t>();
    schema.name = fields.text();
    schema.encoding = fields.text();
    schema.data = fields.text();
    add_once(std::move(schema), head_.schemas);
  } else if (static_cast<Opcode>(opcode) == Opcode::channel) {
    Channel channel;
    channel.id = fields.number<std::uint16_t>();
    channel.schema_id = fields.number<std::uint16_t>();
    channel.topic = fields.text();
    channel.message_encoding = fields.text();
    add_once(std::move(channel), head_.channels);
  } else if (static_cast<Opcode>(opcode) == Opcode::attachment) {
    take_attachment(content);
  }
}

void FileReader::take_attachment(std::string_view content) {
  Fields fields(*this, content);
  Attachment attachment;
  fields.take(8 + 8);
  attachment.name = fields.text();
  attachment.media_type = fields.text();
  attachment.data = fields.take(fields.number<std::uint64_t>());
  const std::uint32_t found = crc32(content.substr(0, content.size() - fields.rest().size()));
  const auto crc = fields.number<std::uint32_t>();
  if (crc != 0 && crc != found) {
    fail(fmt::format("damaged: the checksum of attachment {} differs", attachment.name),
         "a recording as it was written");
  }
  head_.attachments.push_back(std::move(attachment));
}

void FileReader::take_chunk(const Place& place, std::string_view content,
                            std::string& records) const {
  const auto damaged = [&](std::string_view what) {
    fail(fmt::format("damaged: byte {}: {}", place.offset, what), "a recording as it was written");
  };
  Fields fields(*this, content);
  fields.take(8 + 8);
  const auto size = fields.number<std::uint64_t>();
  const auto crc = fields.number<std::uint32_t>();
  const std::string_view compression = fields.text();
  const std::string_view packed = fields.take(fields.number<std::uint64_t>());
  if (size > kMostUnpackedBytes) {
    fail(fmt::format("byte {}: a chunk of {} bytes", place.offset, size), "at most 256 MiB");
  }
  if (compression == "zstd") {
    records.resize(size);
    const std::size_t found =
        ZSTD_decompress(records.data(), records.size(), packed.data(), packed.size());
    if (ZSTD_isError(found) != 0 || found != size) {
      damaged("a chunk cannot be unpacked");
    }
  } else if (compression.empty()) {
    records = packed;
  } else {
    fail(fmt::format("byte {}: compressed by {}", place.offset, compression), "zstd, or nothing");
  }
  if (crc != 0 && crc != crc32(records)) damaged("a chunk's checksum differs");
}

bool FileReader::load_next_chunk() {
  if (next_chunk_ == chunks_.size()) {
    if (!cut_.empty()) fail(cut_, "all of it");
    return false;
  }
  const Place& place = chunks_[next_chunk_++];
  in_.clear();
  in_.seekg(static_cast<std::streamoff>(place.offset));
  offset_ = place.offset;
  const std::string content = read_bytes(place.length);
  take_chunk(place, content, records_);
  at_ = 0;
  return true;
}

bool FileReader::next(Message& out) {
  while (true) {
    while (at_ >= records_.size()) {
      if (!load_next_chunk()) return false;
    }
    Fields fields(*this, std::string_view(records_).substr(at_));
    const auto opcode = fields.number<std::uint8_t>();
    if (opcode == 0) fail("damaged: a record without a kind in a chunk", "one as it was written");
    const std::string_view content = fields.take(fields.number<std::uint64_t>());
    at_ = records_.size() - fields.rest().size();
    if (static_cast<Opcode>(opcode) != Opcode::message) {
      // Others' programs put channels into chunks.
      take_record(opcode, std::string(content));
      continue;
    }
    Fields message(*this, content);
    out.channel = message.number<std::uint16_t>();
    message.take(4);
    out.time_ns = message.number<std::uint64_t>();
    message.take(8);
    out.data = message.rest();
    return true;
  }
}

}  // namespace berth::mcap
