#include "berth/record/tape.hpp"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <utility>

#include "berth/files/error.hpp"
#include "berth/record/depth_message.hpp"
#include "berth/record/ring.hpp"
#include "berth/results/result_json.hpp"

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

namespace {

/// What was put waits so long at most: who puts need not wake anybody.
constexpr std::chrono::milliseconds kPause{10};

std::size_t bytes_of(const RecordedImage& image) {
  return image.depth_m.pixels().size() * sizeof(float);
}

/// About what a request takes in memory.
std::size_t bytes_of(const RecordedAnswer& answer) {
  return sizeof answer + answer.result.links.size() * sizeof(LinkResult);
}

mcap::Head head_of(const RecordedCell& cell, const RecorderSettings& settings) {
  mcap::Head head = head_of(cell);
  for (const RecordedFile& file : settings.also) {
    head.attachments.push_back({file.name, file.media_type, file.data});
  }
  return head;
}

}  // namespace

Tape::Tape(const RecordedCell& cell, const RecorderSettings& settings)
    : settings_(settings),
      head_(head_of(cell, settings)),
      ring_(std::in_place, settings.file, settings.seconds, mcap::beginning_of_file(head_),
            settings.most_files),
      writer_(settings.file, head_,
              [this](const auto& file, const std::string& error) { note(file, error); }) {
  std::filesystem::path first = settings.file;
  first += ".ring";
  if (ring_->folder() != first) {
    tell(fmt::format("{}: a program that crashed, or that still runs, left it; this one's is {}",
                     first.string(), ring_->folder().string()));
  }
  for (const auto& mounted : cell.cameras) camera_names_.push_back(mounted->mount().name);
  thread_ = std::jthread([this] { run(); });
}

Tape::~Tape() { finish(); }

std::unique_ptr<RecordedAnswer> Tape::spare_answer() {
  {
    const std::lock_guard lock(mutex_);
    if (!spare_.empty()) {
      std::unique_ptr<RecordedAnswer> spare = std::move(spare_.back());
      spare_.pop_back();
      return spare;
    }
  }
  return std::make_unique<RecordedAnswer>();
}

bool Tape::put(Waiting one) {
  const std::lock_guard lock(mutex_);
  if (has_failed_ || is_ended_ || waiting_bytes_ + one.bytes > settings_.most_waiting_bytes) {
    if (one.answer) spare_.push_back(std::move(one.answer));
    return false;
  }
  waiting_bytes_ += one.bytes;
  if (one.image) ++counts_.images;
  if (one.answer) ++counts_.requests;
  waiting_.push_back(std::move(one));
  return true;
}

bool Tape::put(std::shared_ptr<const RecordedImage> image) {
  const std::size_t bytes = bytes_of(*image);
  return put(Waiting{.image = std::move(image), .bytes = bytes});
}

bool Tape::put(std::unique_ptr<RecordedAnswer> answer) {
  const std::size_t bytes = bytes_of(*answer);
  return put(Waiting{.answer = std::move(answer), .bytes = bytes});
}

bool Tape::put_joints(double stamp_s, std::string text) {
  const std::size_t bytes = text.size();
  return put(Waiting{.stamp_s = stamp_s, .joints = std::move(text), .bytes = bytes});
}

bool Tape::has_room() const {
  const std::lock_guard lock(mutex_);
  return !has_failed_ && waiting_bytes_ <= settings_.most_waiting_bytes / 2;
}

void Tape::write() { put(Waiting{.is_write = true}); }

void Tape::finish() {
  {
    const std::lock_guard lock(mutex_);
    is_ended_ = true;
  }
  ended_.notify_one();
  if (thread_.joinable()) thread_.join();
  writer_.finish();
  if (!ring_) return;
  const std::lock_guard lock(mutex_);
  if (!counts_.trouble.empty()) {
    ring_->keep();
    counts_.trouble += "; what was recorded before it is in " + ring_->folder().string();
  }
  ring_.reset();
}

RecorderCounts Tape::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void Tape::note(const std::filesystem::path& file, const std::string& error) {
  {
    const std::lock_guard lock(mutex_);
    if (error.empty()) {
      counts_.files.push_back(file);
    } else if (counts_.trouble.empty()) {
      counts_.trouble = error;
    }
  }
  tell(error.empty() ? file.string() + ": written" : error);
}

void Tape::tell(const std::string& sentence) {
  const std::lock_guard lock(telling_);
  if (settings_.tell) settings_.tell(sentence);
}

bool Tape::take_waiting(std::vector<Waiting>& out) {
  std::unique_lock lock(mutex_);
  if (waiting_.empty()) ended_.wait_for(lock, kPause, [this] { return is_ended_; });
  std::swap(waiting_, out);
  return !is_ended_ || !out.empty();
}

template <class Write>
bool Tape::write_or_fail(Write write) {
  try {
    write();
    return true;
  } catch (const std::exception& error) {
    note({}, error.what());
  }
  const std::lock_guard lock(mutex_);
  has_failed_ = true;
  return false;
}

void Tape::done_with(Waiting& one, bool is_written) {
  const std::lock_guard lock(mutex_);
  waiting_bytes_ -= one.bytes;
  if (!is_written && one.image) --counts_.images, ++counts_.lost_images;
  if (!is_written && one.answer) --counts_.requests, ++counts_.lost_requests;
  if (one.answer) spare_.push_back(std::move(one.answer));
}

void Tape::run() {
  bool works = true;
  std::vector<Waiting> taken;
  while (take_waiting(taken)) {
    for (Waiting& one : taken) {
      works = works && write_or_fail([&] { take(one); });
      done_with(one, works);
    }
    taken.clear();
    works = works && write_or_fail([&] { ring_->flush_if_old(); });
  }
  // Its time did not come.
  if (due_s_ && works) write_or_fail([&] { write_ring(); });
}

void Tape::take(const Waiting& one) {
  if (one.image) {
    take(*one.image);
  } else if (one.answer) {
    take(*one.answer);
  } else if (one.is_write) {
    write_ring(true);
  } else {
    ring_->add(kJointsChannel, time_ns(one.stamp_s), one.joints);
  }
}

void Tape::take(const RecordedImage& image) {
  const double stamp_s = image.exposure.joints.stamp_s;
  const std::string message = depth_message(image.depth_m, stamp_s, camera_names_[image.camera]);
  if (image.is_background) {
    return ring_->add(channel_of(image.camera, kBackgroundOfCamera), time_ns(stamp_s), message);
  }
  ring_->add(channel_of(image.camera, kExposureOfCamera), time_ns(stamp_s),
             json_text(image.exposure));
  ring_->add(channel_of(image.camera, kDepthOfCamera), time_ns(stamp_s), message);
}

void Tape::take(RecordedAnswer& answer) {
  const std::uint64_t at_ns = time_ns(answer.time_s);
  if (answer.begins) {
    ring_->begin_segment(answer.elapsed_s);
    ring_->add(kBeginChannel, at_ns, json_text(answer.begin));
    for (const auto& image : answer.needed) take(*image);
  }
  answer.needed.clear();
  if (answer.request.is_monitored) answer.result.separation = answer.separation;
  ring_->add(kRequestChannel, at_ns, json_text(answer.request));
  ring_->add(kResultChannel, at_ns, result_json(answer.result));
  answer.result.separation.reset();
  if (answer.is_stop && settings_.on_stop && !due_s_) {
    due_s_ = answer.elapsed_s + settings_.after_stop_s;
  }
  if (!due_s_ || answer.elapsed_s < *due_s_) return;
  write_ring();
}

void Tape::write_ring(bool is_asked_for) {
  if (due_s_.has_value()) {
    due_s_.reset();
    if (++stops_ > settings_.most_files && !is_asked_for) {
      return tell(fmt::format("{}: the recording of stop {} is not written: most_files is {}",
                              settings_.file.string(), stops_, settings_.most_files));
    }
  }
  std::vector<SegmentPart> parts = ring_->parts();
  if (parts.empty()) {
    return tell(settings_.file.string() + ": not written: no request was recorded");
  }
  writer_.write(std::move(parts));
}

}  // namespace berth
