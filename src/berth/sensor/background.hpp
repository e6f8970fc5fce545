#pragma once

#include <limits>

#include "berth/self_filter/self_filter.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/sensor/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The memory of find_beside_robot().
struct BesideRobotWorkspace {
  RobotImage links;
  SelfFilterWorkspace filter;
  ObstacleImage left;
};

/// How near to the robot in the image, at its depth, cameras leave a dark outline and a stereo
/// shadow: a pixel that has no reading there says nothing.
inline constexpr double kRobotShadow_m = 0.06;

/// Which pixels the evaluated links do not cover once they are grown by `clearance_m` in the image,
/// on all sides and at all depths: of those with a depth, all whose fate is `obstacle`. Until the
/// next call.
const Image<PixelFate>& find_beside_robot(const Camera& camera, DepthView depth_m,
                                          const RobotImage& robot, double clearance_m,
                                          BesideRobotWorkspace& workspace);

class Background;

/// Knowledge of one camera's surroundings, beside its image.
struct KnownPlace {
  /// The empty cell; null: nobody has learned it.
  const Background* background = nullptr;
  /// Environment's surface at each pixel that would show it if there were no robot; NaN elsewhere.
  /// Without environment of no size.
  DepthView environment_m = {};
  /// Of environment's surface.
  Tolerance tolerance = {};
  /// Whether each pixel has a reading while nothing keeps the light from the camera: wherever there
  /// is none, something may be (NoReading::hides).
  bool always_reads = false;
};

/// What a camera that does not move sees of the empty cell: per pixel the depth of what stands
/// there, environment or anything else, learned from images in which the robot was elsewhere, and
/// whether it has a reading at all.
///
/// It only ever adds: a reading that is kept stays as it is, whatever the background says. What the
/// sensor makes up beside the arm and a new thing that somebody holds there give the same image, so
/// both are kept.
class Background {
 public:
  /// Takes in one image. A reading counts where the self filter (`fates`) kept it or took it for
  /// environment, and the evaluated links, grown by background_clearance_m on all sides and at all
  /// depths, do not cover it. A pixel's readings agree as long as none differs from the least of
  /// them by more than the noise; one that does begins anew. Nearer to the robot, but not within
  /// kRobotShadow_m, a reading reports no more than that there is one. Nothing is known of a pixel
  /// that lost its reading there in more than a quarter as many images as had one: cameras flicker
  /// at outlines and on what is far.
  void learn(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
             const Image<PixelFate>& fates, const SensorSettings& settings);

  /// Takes this as learned, in place of what was, as depth_m() has it.
  void assign(DepthView depth_m, const SensorSettings& settings);

  /// depth_m() of all pixels of the camera.
  DepthImage learned_m(const Camera& camera, const SensorSettings& settings) const;

  /// Whether anything is learned for images of this size.
  bool is_of(int width, int height) const {
    return count_.width() == width && count_.height() == height;
  }

  /// The least of the readings once background_frames of them agree. Infinite where they do not,
  /// but this number of images has one there; else NaN.
  float depth_m(int u, int v, const SensorSettings& settings) const {
    if (4 * lost_count_(u, v) > read_count_(u, v)) return kNoDepth;
    if (count_(u, v) >= settings.background_frames) return least_m_(u, v);
    return read_count_(u, v) >= settings.background_frames ? kReadAtUnknownDepth_m : kNoDepth;
  }

  /// Puts the background where F has no depth: behind the robot, in its padding, at dropped pixels
  /// and where there is no reading. Such a pixel's fate is `background`. It is not put where a
  /// reading lies farther away than it, since what was there is gone then, and neither onto
  /// environment nor where it is environment itself, within the tolerance of `place`.
  void complete(DepthView sensor_depth_m, const KnownPlace& place, const SensorSettings& settings,
                ObstacleImage& out) const;

 private:
  static constexpr float kReadAtUnknownDepth_m = std::numeric_limits<float>::infinity();

  void learn_pixel(int u, int v, float z_m, const SensorSettings& settings);

  Image<int> count_;
  Image<int> read_count_;
  Image<int> lost_count_;
  DepthImage least_m_;
  /// Scratch of learn.
  DepthImage anywhere_m_;
  BesideRobotWorkspace workspace_;
};

}  // namespace berth
