#include "berth/record/ring.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "berth/files/error.hpp"
#include "berth/record/mcap_file.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// Bytes that are packed together: an image or a few.
constexpr std::size_t kChunkBytes = std::size_t{2} << 20;
/// A crash takes what was added in this time.
constexpr std::chrono::milliseconds kMostUnwritten{200};

constexpr const char* kExpected = "an existing folder with leave to write and room";

fs::path make_folder(const fs::path& file, int most) {
  for (int i = 1; i <= most; ++i) {
    fs::path folder = numbered(file, i);
    folder += ".ring";
    std::error_code error;
    if (fs::create_directory(folder, error)) return folder;
    if (error) throw_bad_file({folder}, "cannot be made: " + error.message(), kExpected);
  }
  throw_bad_file({file}, fmt::format("{} rings of programs that crashed are there", most),
                 "fewer: FILE.ring, FILE_2.ring and so on can be replayed, and taken away");
}

}  // namespace

Segment::Segment(fs::path file, std::string_view beginning)
    : file_(std::move(file)), chunks_begin_(beginning.size()) {
  errno = 0;
  out_.open(file_, std::ios::binary);
  write(beginning);
}

Segment::~Segment() {
  out_.close();
  std::error_code ignored;
  if (!is_kept_) fs::remove(file_, ignored);
}

void Segment::write(std::string_view bytes) {
  if (out_.is_open()) errno = 0;
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out_.flush();
  if (out_) return;
  throw_bad_file({file_}, "cannot be written: " + std::generic_category().message(errno),
                 kExpected);
}

void Segment::append(const mcap::ChunkInfo& info, std::string_view bytes) {
  write(bytes);
  chunks_.push_back(info);
}

void Segment::end() { write(mcap::end_without_index()); }

Ring::Ring(const fs::path& file, double seconds, std::string beginning, int most_folders)
    : folder_(make_folder(file, most_folders)),
      seconds_(seconds),
      beginning_(std::move(beginning)) {}

Ring::~Ring() {
  segments_.clear();
  std::error_code ignored;
  if (!is_kept_) fs::remove(folder_, ignored);
}

void Ring::begin_segment(double elapsed_s) {
  flush();
  if (!segments_.empty()) segments_.back().segment->end();
  const fs::path file = folder_ / fmt::format("{:06}.mcap", ++made_);
  segments_.push_back({elapsed_s, std::make_shared<Segment>(file, beginning_)});
  while (segments_.size() > 1 && segments_[1].begin_s <= elapsed_s - seconds_) {
    segments_.pop_front();
  }
}

void Ring::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view data) {
  // What comes before the first segment is given again with it.
  if (segments_.empty()) return;
  chunk_.add(channel, time_ns, data);
  if (chunk_.size() >= kChunkBytes) flush();
}

void Ring::flush() {
  flushed_ = std::chrono::steady_clock::now();
  if (chunk_.is_empty()) return;
  bytes_.clear();
  const mcap::ChunkInfo info = chunk_.finish(bytes_);
  segments_.back().segment->append(info, bytes_);
}

void Ring::flush_if_old() {
  if (std::chrono::steady_clock::now() - flushed_ >= kMostUnwritten) flush();
}

std::vector<SegmentPart> Ring::parts() {
  flush();
  std::vector<SegmentPart> parts;
  for (const auto& [begin_s, segment] : segments_) parts.push_back({segment, segment->chunks()});
  return parts;
}

void Ring::keep() {
  is_kept_ = true;
  for (const Timed& timed : segments_) timed.segment->keep();
}

}  // namespace berth
