// Inside record/ only: the last seconds on disk.
#pragma once

#include <fmt/format.h>
#include <chrono>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "berth/record/mcap_file.hpp"

namespace berth {

/// FILE.mcap, FILE_2.mcap, ...: the i-th, from 1 on.
inline std::filesystem::path numbered(const std::filesystem::path& file, int i) {
  if (i == 1) return file;
  std::filesystem::path other = file;
  return other.replace_filename(
      fmt::format("{}_{}{}", file.stem().string(), i, file.extension().string()));
}

/// An MCAP file without an index. It can be read while it is written, and as far as it was written
/// when the program ended. It goes with the object.
class Segment {
 public:
  /// Begins with these bytes. Throws std::runtime_error where it cannot be written, as append() and
  /// end() do.
  Segment(std::filesystem::path file, std::string_view beginning);
  ~Segment();
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  void append(const mcap::ChunkInfo& info, std::string_view bytes);
  /// Nothing is appended any more.
  void end();
  /// The file stays when the object goes.
  void keep() { is_kept_ = true; }
  /// Where the first chunk is in the file.
  std::uint64_t chunks_begin() const { return chunks_begin_; }
  const std::filesystem::path& file() const { return file_; }
  const std::vector<mcap::ChunkInfo>& chunks() const { return chunks_; }

 private:
  void write(std::string_view bytes);

  std::filesystem::path file_;
  std::ofstream out_;
  std::uint64_t chunks_begin_;
  bool is_kept_ = false;
  std::vector<mcap::ChunkInfo> chunks_;
};

/// What a segment had at one time. It stays on disk for who holds it.
struct SegmentPart {
  std::shared_ptr<const Segment> segment;
  std::vector<mcap::ChunkInfo> chunks;
};

/// Segments of a recording, each of which can be replayed without those before. Belongs to one
/// thread.
class Ring {
 public:
  /// Makes a folder, the first of FILE.ring, FILE_2.ring, ... that is not there, of `most_folders`.
  /// It goes with the object. Each segment begins with `beginning`. Throws std::runtime_error where
  /// it cannot.
  Ring(const std::filesystem::path& file, double seconds, std::string beginning, int most_folders);
  ~Ring();
  Ring(const Ring&) = delete;
  Ring& operator=(const Ring&) = delete;

  /// All that follows is of a new segment. Those that lie before the last seconds are dropped.
  /// `elapsed_s` counts from the ring's first segment on. Each throws std::runtime_error where the
  /// disk is full.
  void begin_segment(double elapsed_s);
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view data);
  /// What was added long ago is put on disk, so that no crash can take it.
  void flush_if_old();
  /// All of it, up to what was added last.
  std::vector<SegmentPart> parts();
  /// The folder and what is in it stay when the object goes.
  void keep();
  const std::filesystem::path& folder() const { return folder_; }

 private:
  struct Timed {
    double begin_s;
    std::shared_ptr<Segment> segment;
  };

  void flush();

  std::filesystem::path folder_;
  double seconds_;
  std::string beginning_;
  bool is_kept_ = false;
  std::deque<Timed> segments_;
  int made_ = 0;
  mcap::ChunkBuilder chunk_;
  std::string bytes_;
  std::chrono::steady_clock::time_point flushed_ = std::chrono::steady_clock::now();
};

}  // namespace berth
