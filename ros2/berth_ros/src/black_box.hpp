// What the monitor saw and said in the last seconds, in a file where it stopped the robot.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <thread>
#include <vector>

#include "berth/record/recorder.hpp"

namespace berth_ros {

/// A berth::Recorder for a node's cameras as they are mounted at the moment. Where one of them is
/// another one, or elsewhere, the next recorder takes over, and what comes until it is ready is not
/// recorded. One thread asks; any may give frames. Nobody waits for the disk.
class BlackBox {
 public:
  /// Gets a sentence for each recording and each trouble. Called by any thread.
  using Tell = std::function<void(const std::string&)>;

  /// An empty file: nothing is recorded. Throws std::invalid_argument where its folder is not
  /// there, or for a time that is not above 0.
  BlackBox(berth::RecorderSettings settings, Tell tell);
  /// Waits until everything is written.
  ~BlackBox();

  /// From now on it is about this robot and this monitor; null: none.
  void use(std::shared_ptr<const berth::Robot> robot,
           std::optional<berth::SeparationSettings> separation, std::size_t cameras);
  /// See berth::Recorder. Frames of another robot are passed over.
  void put(std::size_t camera, const berth::Frame& frame, berth::DepthView depth_m);
  void push_joints(double stamp_s, const std::vector<std::string>& names,
                   const std::vector<double>& positions);
  /// Calls use() with the recorder, which nobody exchanges meanwhile; with null where nothing is
  /// recorded, or where a frame's camera is about to be mounted anew. By the thread that asks.
  template <class Use>
  void record(const berth::Request& request, const Use& use) {
    const std::shared_lock lock(mutex_);
    use(recorder_ && knows_all(request) ? recorder_.get() : nullptr);
  }
  /// Writes a recording of what there is; false: nothing is. By the thread that asks.
  bool write();

 private:
  using MountedCameras = std::vector<std::shared_ptr<const berth::MountedCamera>>;

  void mount(std::size_t camera, const std::shared_ptr<const berth::MountedCamera>& mounted);
  /// False for a frame whose camera is about to be mounted anew.
  bool knows_all(const berth::Request& request) const;
  /// To be called with the mutex where robot, monitor or cameras are others.
  void retire();
  void run(const std::stop_token& stop);
  /// Null where no camera is known, or nothing can be written.
  std::unique_ptr<berth::Recorder> make(const MountedCameras& cameras,
                                        std::optional<berth::SeparationSettings> separation) const;

  berth::RecorderSettings settings_;
  Tell tell_;
  /// Held alone where any of these becomes another one.
  std::shared_mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const berth::Robot> robot_;
  std::optional<berth::SeparationSettings> separation_;
  MountedCameras mounted_;
  /// Null until there is one of these cameras.
  std::unique_ptr<berth::Recorder> recorder_;
  /// What they have to write still is written before another one begins.
  std::vector<std::unique_ptr<berth::Recorder>> retired_;
  bool has_changed_ = false;
  /// The last member: the thread uses all the others.
  std::jthread thread_;
};

}  // namespace berth_ros
