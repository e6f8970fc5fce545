#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include "berth/render/robot_renderer.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/watch/seen_through.hpp"

namespace berth {

/// The belief about one camera's images, as far as simple mistakes get it wrong.
struct CameraBelief {
  /// Whose images they are: the number of a camera of the scene.
  std::size_t images_of = 0;
  CameraMount mount;
  /// Each reading times this.
  double depth_factor = 1;
  /// The two bytes of each number stand the other way round.
  bool is_swapped = false;
  /// Readings are distances from the camera, not along its axis.
  bool is_along_ray = false;
  /// The images' columns from right to left.
  bool is_mirrored = false;
  /// Of each of RobotInImages::frames(), in the order of RobotModel::joints, rad or m.
  std::vector<std::vector<double>> positions;
};

/// Some images of one camera of a scene, and how much of the robot is in them where it is believed
/// to be.
class RobotInImages {
 public:
  /// Looks at no more images than this, which lie evenly over those whose joints are known.
  static constexpr std::size_t kMostFrames = 8;

  /// The scene has to outlive it.
  RobotInImages(const OpenScene& scene, std::size_t camera);

  const OpenCamera& camera() const { return scene_.cameras[camera_]; }
  /// The numbers of the images that are looked at.
  const std::vector<std::size_t>& frames() const { return frames_; }
  /// As the scene says.
  const CameraBelief& given() const { return given_; }

  /// All frames together. Throws as depth_m() does.
  RobotReadings readings(const CameraBelief& belief);

  /// Of frames()[i] alone.
  RobotReadings readings(const CameraBelief& belief, std::size_t i);

  /// All frames together, for each of RobotModel::evaluated_links.
  std::vector<RobotReadings> readings_of_links(const CameraBelief& belief);

  /// Image number `frame` of a camera, with readings that near_m and far_m leave out: a wrong
  /// scale takes all of them out of these limits. Empty where it has none or its size is not this
  /// camera's. Throws std::runtime_error where it cannot be read again.
  const DepthImage& depth_m(std::size_t camera, std::size_t frame);

 private:
  /// Draws the robot in frames()[i] and makes of the image what is believed of it; false where
  /// there is none.
  bool believe(const CameraBelief& belief, const MountedCamera& mounted, RobotRenderer& renderer,
               std::size_t i);

  const OpenScene& scene_;
  std::size_t camera_;
  std::vector<std::size_t> frames_;
  CameraBelief given_;
  /// By camera and frame.
  std::map<std::pair<std::size_t, std::size_t>, DepthImage> depth_m_;
  DepthImage changed_m_;
  RobotPose pose_;
  RobotImage robot_;
};

}  // namespace berth
