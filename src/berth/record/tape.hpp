// Inside record/ only: the thread that packs and writes, and what waits for it.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "berth/pipeline/result.hpp"
#include "berth/record/mcap_file.hpp"
#include "berth/record/recorded_cell.hpp"
#include "berth/record/recorded_messages.hpp"
#include "berth/record/recorder.hpp"
#include "berth/record/ring.hpp"

namespace berth {

/// Writes recordings of what a ring has, in a thread of its own, so that the ring goes on
/// meanwhile.
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

struct RecordedImage {
  std::size_t camera = 0;
  /// It is no frame's image, but what the camera's observer takes for its background.
  bool is_background = false;
  RecordedExposure exposure;
  DepthImage depth_m;
};

/// One request and its result. Its memory is used again.
struct RecordedAnswer {
  double time_s = 0;
  /// Since the recorder began.
  double elapsed_s = 0;
  /// A segment begins with it, and needs these images besides those to come.
  bool begins = false;
  RecordedBegin begin;
  std::vector<std::shared_ptr<const RecordedImage>> needed;
  RecordedRequest request;
  /// Without the monitor's part.
  Result result;
  /// Where the request is monitored.
  Separation separation;
  /// The robot may not go on any more.
  bool is_stop = false;
};

/// A caller never waits for the disk, and once its memory is warm, an answer is taken
/// without an allocation.
class Tape {
 public:
  /// Throws as Ring does.
  Tape(const RecordedCell& cell, const RecorderSettings& settings);
  ~Tape();

  /// To be filled and put, with what it had before.
  std::unique_ptr<RecordedAnswer> spare_answer();
  /// Each returns whether it is taken: not where too much waits, or the disk has failed. From any
  /// thread.
  bool put(std::shared_ptr<const RecordedImage> image);
  bool put(std::unique_ptr<RecordedAnswer> answer);
  bool put_joints(double stamp_s, std::string text);
  /// Whether there is room for a segment to begin: half of what may wait.
  bool has_room() const;
  /// A recording of what was put so far.
  void write();
  /// Waits until everything is written.
  void finish();

  /// Without what was not put. What was put and could not be written is lost.
  RecorderCounts counts() const;

 private:
  /// One of the four.
  struct Waiting {
    std::shared_ptr<const RecordedImage> image = {};
    std::unique_ptr<RecordedAnswer> answer = {};
    double stamp_s = 0;
    std::string joints = {};
    std::size_t bytes = 0;
    bool is_write = false;
  };

  bool put(Waiting one);
  void run();
  /// Waits for some time; false where nothing will come any more.
  bool take_waiting(std::vector<Waiting>& out);
  void done_with(Waiting& one, bool is_written);
  /// Whether that worked; if not, nothing is written from now on.
  template <class Write>
  bool write_or_fail(Write write);
  void take(const Waiting& one);
  void take(const RecordedImage& image);
  void take(RecordedAnswer& answer);
  /// Of stops no more than RecorderSettings::most_files; what is asked for always.
  void write_ring(bool is_asked_for = false);
  void note(const std::filesystem::path& file, const std::string& error);
  void tell(const std::string& sentence);

  RecorderSettings settings_;
  mcap::Head head_;
  std::vector<std::string> camera_names_;
  mutable std::mutex mutex_;
  std::condition_variable ended_;
  std::vector<Waiting> waiting_;
  std::size_t waiting_bytes_ = 0;
  std::vector<std::unique_ptr<RecordedAnswer>> spare_;
  bool is_ended_ = false;
  RecorderCounts counts_;
  bool has_failed_ = false;
  std::mutex telling_;
  /// The rest is the thread's.
  /// None after finish().
  std::optional<Ring> ring_;
  RecordingWriter writer_;
  /// When a recording is due, by RecordedAnswer::elapsed_s.
  std::optional<double> due_s_;
  int stops_ = 0;
  /// The last member: it uses all the others.
  std::jthread thread_;
};

}  // namespace berth
