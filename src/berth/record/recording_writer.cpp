#include "berth/record/recording_writer.hpp"

#include <fstream>
#include <utility>

#include "berth/files/error.hpp"
#include "berth/record/ring.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

/// The first that is not there.
fs::path free_name(const fs::path& file) {
  int i = 1;
  while (fs::exists(numbered(file, i))) ++i;
  return numbered(file, i);
}

void copy(const SegmentPart& part, mcap::FileWriter& out) {
  std::ifstream in(part.segment->file(), std::ios::binary);
  in.seekg(static_cast<std::streamoff>(part.segment->chunks_begin()));
  std::string bytes;
  for (const mcap::ChunkInfo& info : part.chunks) {
    bytes.resize(info.length());
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) {
      throw_bad_file({part.segment->file()}, "cannot be read", "what was written there");
    }
    out.begin_chunk(info);
    out.write(bytes);
  }
}

}  // namespace

RecordingWriter::RecordingWriter(fs::path file, const mcap::Head& head, Done done)
    : file_(std::move(file)), head_(head), done_(std::move(done)), thread_([this] { run(); }) {}

RecordingWriter::~RecordingWriter() { finish(); }

void RecordingWriter::write(std::vector<SegmentPart> parts) {
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(parts));
  }
  changed_.notify_one();
}

void RecordingWriter::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void RecordingWriter::run() {
  while (true) {
    std::vector<SegmentPart> parts;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return is_ended_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      parts = std::move(waiting_.front());
      waiting_.pop_front();
    }
    fs::path file;
    std::string error;
    try {
      file = free_name(file_);
      write_file(file, parts);
    } catch (const std::exception& what) {
      error = what.what();
    }
    done_(file, error);
  }
}

void RecordingWriter::write_file(const fs::path& file,
                                 const std::vector<SegmentPart>& parts) const {
  mcap::FileWriter out(file, head_);
  for (const SegmentPart& part : parts) copy(part, out);
  out.finish();
}

}  // namespace berth
