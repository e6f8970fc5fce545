#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "berth/live/joint_intake.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

class Observer;

/// How images and joints of a running camera go together.
struct LiveCameraSettings {
  /// The joints' clock at an exposure is the image's stamp plus this.
  double clock_offset_s = 0;
  /// An image waits so long, by this computer's steady clock, for the joints around its exposure,
  /// and for the place of its camera. Then it is observed without them, and its status says what is
  /// missing. At most 60.
  double max_wait_s = 0.1;
};

/// How many images wait at most. Of more the one before the newest is dropped: the oldest is the
/// first whose joints come. Of several whose joints are known all but the newest are, since a newer
/// one shows more.
inline constexpr std::size_t kMostWaitingImages = 3;

/// What became of a camera's images.
struct LiveCameraCounts {
  std::int64_t images = 0;   ///< that were observed
  std::int64_t dropped = 0;  ///< that were not, since newer ones had come
  std::int64_t stale = 0;    ///< whose time was not ok
  double last_wait_s = 0;    ///< of the newest image, for its joints and for a processor
  double longest_wait_s = 0;
  double last_observe_s = 0;  ///< how long it took to observe the newest image
  std::int64_t failed = 0;    ///< that an exception ended, so that there is no frame of them
  /// Of the last one that failed; empty where the newest image was observed.
  std::string failure;
};

/// Where a camera and the robot's root were at an exposure, for those that move otherwise than by
/// the robot's joints; none as long as that is not known. Called by several threads at a time; must
/// not throw, nor call the LiveCamera.
using FindPlace = std::function<std::optional<PlaceAtExposure>(double stamp_s)>;

/// A running camera: images come from any thread, wait for the joints around their exposure, and a
/// thread of its own makes frames of them.
class LiveCamera {
 public:
  /// A frame, the image it was made of, and what push() was given with it.
  using OnFrame = std::function<void(const std::shared_ptr<const Frame>&, DepthView depth_m,
                                     const std::shared_ptr<const void>& with)>;

  /// `joints` outlives it. `on_frame` is called in the camera's thread, after newest() has the
  /// frame; it must not wait for another thread: other images wait for it. What it or the
  /// observation throws is counted (LiveCameraCounts::failed), and the next image goes on.
  /// Without `find_place` the camera stands as its mount says, and the root stands still. `before`
  /// is what the camera was found to be, such as by the LiveCamera of it before, as for PoseWatch.
  /// Throws std::invalid_argument for a setting outside of its domain.
  LiveCamera(std::shared_ptr<const MountedCamera> mounted, const JointIntake& joints,
             LiveCameraSettings settings = {}, OnFrame on_frame = {}, FindPlace find_place = {},
             const CameraWatch& before = {});
  /// Ends the thread; images that wait are dropped.
  ~LiveCamera();
  LiveCamera(const LiveCamera&) = delete;
  LiveCamera& operator=(const LiveCamera&) = delete;

  /// Takes an image: as large as the camera's, NaN where there is no reading. Throws
  /// std::invalid_argument for another size.
  void push(double stamp_s, DepthImage depth_m, std::shared_ptr<const void> with = {});
  /// An image whose memory is not used any more, of any size and content: fill it and push it.
  DepthImage spare_image();
  /// To be called after each JointIntake::push, and when places may have become known: an image may
  /// wait for it.
  void look_again();

  /// Whether the camera is implausible whatever its frames say, from its next frame on: somebody
  /// found out more than one frame shows. With WatchSettings::tell_only it is unconfirmed. From any
  /// thread.
  void distrust(bool is_distrusted) { is_distrusted_ = is_distrusted; }

  const std::shared_ptr<const MountedCamera>& mounted() const { return mounted_; }
  /// Null before the first one. Constant, and kept for who holds it.
  std::shared_ptr<const Frame> newest() const;
  LiveCameraCounts counts() const;

 private:
  struct Waiting {
    double stamp_s = 0;
    DepthImage depth_m;
    std::shared_ptr<const void> with;
    double since_s = 0;
  };

  void run(const std::stop_token& stop);
  /// Whether there is one that is ready; not so at the end.
  bool wait_for_image(const std::stop_token& stop);
  /// The newest image that is ready.
  std::optional<Waiting> take_newest();
  void drop(std::deque<Waiting>::iterator image);
  /// Observes it, and hands it over.
  void take(Observer& observer, const Waiting& image);
  std::shared_ptr<const Frame> observe(Observer& observer, const Waiting& image);
  void keep(const Waiting& image, const std::shared_ptr<const Frame>& frame, double begin_s);
  /// Whether the joints after its exposure are there, or it has waited long enough.
  bool is_ready(const Waiting& image) const;
  bool has_joints(const Waiting& image) const;
  std::optional<PlaceAtExposure> place_of(const Waiting& image) const;

  std::shared_ptr<const MountedCamera> mounted_;
  const JointIntake& joints_;
  LiveCameraSettings settings_;
  OnFrame on_frame_;
  FindPlace find_place_;
  CameraWatch before_;
  std::atomic<bool> is_distrusted_ = false;
  FramePool pool_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Waiting> waiting_;
  std::vector<DepthImage> spare_;
  std::shared_ptr<const Frame> newest_;
  LiveCameraCounts counts_;
  /// The last member: the thread uses all the others.
  std::jthread thread_;
};

}  // namespace berth
