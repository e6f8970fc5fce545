// Inside record/ only: writes recordings of what a ring has, in a thread of its own, so that the
// ring goes on meanwhile.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "berth/record/mcap_file.hpp"
#include "berth/record/ring.hpp"

namespace berth {

class RecordingWriter {
 public:
  /// Called in its thread: the file that was written, or why it could not be.
  using Done = std::function<void(const std::filesystem::path& file, const std::string& error)>;

  /// `head` outlives it.
  RecordingWriter(std::filesystem::path file, const mcap::Head& head, Done done);
  /// Waits for all that was asked for.
  ~RecordingWriter();

  /// Writes this as a file of its own: the first free name of FILE.mcap, FILE_2.mcap, ...
  void write(std::vector<SegmentPart> parts);
  /// Waits for all that was asked for, and ends.
  void finish();

 private:
  void run();
  void write_file(const std::filesystem::path& file, const std::vector<SegmentPart>& parts) const;

  std::filesystem::path file_;
  const mcap::Head& head_;
  Done done_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::vector<SegmentPart>> waiting_;
  bool is_ended_ = false;
  /// The last member: the thread uses all the others.
  std::jthread thread_;
};

}  // namespace berth
