#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

/// A file that is put into each recording beside what a replay needs, such as the URDF.
struct RecordedFile {
  std::string name;
  std::string media_type;
  std::string data;
};

/// Where recordings are written, and of what.
struct RecorderSettings {
  /// Where the first recording is written, an MCAP file; the next ones are FILE_2.mcap and so on,
  /// and nothing that is there is overwritten. The ring lies beside it, in the folder
  /// FILE.mcap.ring, or FILE_2.mcap.ring and so on. It goes with the recorder; after a crash, or
  /// where a recording could not be written, it stays, and each of its files can be replayed.
  std::filesystem::path file;
  /// A recording has the last seconds, and up to a quarter more.
  double seconds = 30;
  /// Whether a recording is written each time that a monitor stops the robot.
  bool on_stop = true;
  /// How much of what follows a stop is in its recording.
  double after_stop_s = 1;
  /// The most recordings that are written for stops, and the most rings that crashed programs may
  /// have left: of more, the recorder throws.
  int most_files = 20;
  /// What may wait for the disk, in memory. What comes beyond that is lost, and is told.
  std::size_t most_waiting_bytes = std::size_t{256} << 20;
  std::vector<RecordedFile> also = {};
  /// Gets a sentence for each recording that was written, and for each trouble. Called in the
  /// recorder's threads, one call at a time; must not throw.
  std::function<void(const std::string&)> tell = {};
};

/// What became of what a recorder was given.
struct RecorderCounts {
  /// In the ring, or on their way to it.
  std::int64_t images = 0;
  std::int64_t requests = 0;
  /// What the disk was too slow for, or what came after it failed. A replay begins anew after it.
  std::int64_t lost_images = 0;
  std::int64_t lost_requests = 0;
  /// The recordings, as far as they were written.
  std::vector<std::filesystem::path> files;
  /// What went wrong first; empty: nothing.
  std::string trouble;
};

/// A black box: what a monitor saw and said in the last seconds, in a ring on disk. A recording has
/// depth images, joints, all settings, the robot, requests, and results, and Replay gives these
/// results once more from it, to the last bit. A thread of its own packs and writes; who gives it
/// something only waits for a copy to be made, and a request allocates nothing once it is warm.
///
/// It asks for you, since it has to know which joints a buffer gave, and since each quarter of the
/// ring begins with a request that knows nothing of those before (Query::forget): that one takes as
/// long as a first one, where its space was not prepared.
class Recorder {
 public:
  /// For one loop: one Query, and at most one monitor, with these settings; none: nothing is
  /// monitored. All frames are of these cameras. Throws std::runtime_error where the folder cannot
  /// be written to, std::invalid_argument for a setting outside of its domain.
  Recorder(std::shared_ptr<const Robot> robot,
           std::vector<std::shared_ptr<const MountedCamera>> cameras,
           std::optional<SeparationSettings> separation, RecorderSettings settings);
  /// As finish(), without a word.
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// A frame, and the image it was made of: before anybody may ask it. From any thread, such as in
  /// LiveCamera::OnFrame. Throws std::invalid_argument for a camera that is none of these.
  void put(const Frame& frame, DepthView depth_m);
  /// What a camera's observer takes for its background from now on (Observer::background_m), for
  /// those whose settings ask for one.
  void put_background(const MountedCamera& mounted, DepthView depth_m);
  /// A joint message as it came, for people: a replay has the joints of requests and images. From
  /// any thread.
  void push_joints(double stamp_s, std::span<const std::string> names,
                   std::span<const double> positions);

  /// query.ask(request), recorded from the first one on whose frames were all put, but for its
  /// look-ahead, whose last digits depend on how threads share it. In one thread.
  const Result& ask(Query& query, const Request& request);
  /// monitor.update(...), recorded: after ask(), in its thread, with what it gave. Throws
  /// std::invalid_argument where the recorder was made without settings of a monitor.
  const Separation& update(SeparationMonitor& monitor, const Result& result,
                           const PlannedMotion& motion, double now_s,
                           const FrameSet* frames = nullptr);

  /// Writes a recording of what was given so far. Returns at once. In the thread of ask().
  void write();
  /// Waits until everything is written, a recording that a stop asked for too, and takes the ring
  /// away. Nothing may be given after it. Throws std::runtime_error where something went wrong,
  /// with what, and where the ring is left.
  void finish();

  RecorderCounts counts() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
