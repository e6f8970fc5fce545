#pragma once

#include <memory>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/mounted_camera.hpp"
#include "berth/robot/joint_buffer.hpp"
#include "berth/types/joint_state.hpp"
#include "berth/watch/measure_displacement.hpp"

namespace berth {

/// The camera's clock: depth images to frames. One for each thread.
class Observer {
 public:
  /// `measure` is how the view's WatchSettings::max_displacement_m is watched; without it, as
  /// FrameDisplacement does. `before` is what the camera was found to be by another observer, as
  /// for PoseWatch.
  explicit Observer(std::shared_ptr<const MountedCamera> mounted, MeasureDisplacement measure = {},
                    const CameraWatch& before = {});
  ~Observer();
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;

  /// Renders the robot at the joint angles of the exposure, removes it from the image, and writes
  /// all of `frame`, whose memory it reuses. `depth_m` is as large as the camera's image, NaN where
  /// there is no reading. Throws std::invalid_argument for a wrong size or wrong joints and then
  /// leaves no valid frame. `time` is how the joints were found (joints_at_time); where it is not
  /// ok they are not looked at, and nothing stays in `frame` but the stamp and this.
  void observe(DepthView depth_m, const JointState& at_exposure, Frame& frame, FrameTime time = {},
               const PlaceAtExposure& place = {});

  /// The same for a running camera and robot: the joints are those of the buffer at the exposure,
  /// and stamps have to go forward from call to call (FrameClock). The joints' clock at an exposure
  /// is its stamp plus `clock_offset_s`. Without a place its time is stale_pose.
  void observe(DepthView depth_m, double stamp_s, const JointBuffer& joints, Frame& frame,
               double clock_offset_s = 0,
               const std::optional<PlaceAtExposure>& place = PlaceAtExposure{});

  /// Waits for what the watch measures in the background, and reports it in `frame`, the last one:
  /// for recordings, where nothing is to depend on how long it took.
  void finish_watch(Frame& frame);

  /// Learns what the image shows beside the robot as background of later frames (Background), and
  /// so where the camera can read: what gives no reading there later hides what is behind it.
  /// `frame` is what observe made of `depth_m`; one whose joints are not known (its time is not ok)
  /// or whose camera has moved or is implausible is passed over. Use images of the place as it is
  /// meant to be: somebody who stands still in them becomes background too, and later counts as an
  /// obstacle wherever the robot hides the place. Throws std::invalid_argument where
  /// SensorSettings::background_frames is 0, and for a wrong size.
  void learn_background(DepthView depth_m, const Frame& frame);

  /// What was learned: infinite where there is a reading, but its depth is not known, and NaN where
  /// nothing is known yet. Throws as learn_background does where the
  /// setting is 0.
  DepthImage background_m() const;
  /// Takes this as learned, in place of what was: the background of earlier images. Throws as
  /// learn_background does.
  void set_background(DepthView depth_m);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace berth
