#pragma once

#include <cstdint>

#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// What a camera that does not move sees where the robot is not: per pixel the obstacle's depth,
/// learned from images in which the robot was elsewhere.
///
/// It only ever adds: a reading that is kept stays as it is, whatever the background says. What the
/// sensor makes up beside the arm and a new thing that somebody holds there give the same image, so
/// both are kept.
class Background {
 public:
  /// Takes in one image. A reading counts where the self filter kept it (`fates`) and the evaluated
  /// links, grown by background_clearance_m on all sides and at all depths, do not cover it. A
  /// pixel's readings agree as long as none differs from the least of them by more than the noise;
  /// one that does begins anew.
  void learn(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
             const Image<PixelFate>& fates, const SensorSettings& settings);

  /// Takes this as learned, in place of what was; NaN is not known.
  void assign(DepthView depth_m, const SensorSettings& settings);

  /// depth_m() of all pixels of the camera.
  DepthImage learned_m(const Camera& camera, const SensorSettings& settings) const;

  /// The least of the readings once background_frames of them agree; NaN before that.
  float depth_m(int u, int v, const SensorSettings& settings) const {
    return count_(u, v) >= settings.background_frames ? least_m_(u, v) : kNoDepth;
  }

  /// Puts the background where F has no depth: behind the robot, in its padding, at dropped pixels
  /// and where there is no reading. Such a pixel's fate is `background`. It is not put where a
  /// reading lies farther away than it, since what was there is gone then, and not onto
  /// environment.
  void complete(DepthView sensor_depth_m, const SensorSettings& settings, ObstacleImage& out) const;

 private:
  Image<int> count_;
  DepthImage least_m_;
  /// Scratch of learn.
  RobotImage links_;
  SelfFilterWorkspace workspace_;
  ObstacleImage far_from_robot_;
};

}  // namespace berth
