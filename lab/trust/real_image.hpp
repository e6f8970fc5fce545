// Real depth images without a robot, into which one is drawn: what the sensor does wrong is real,
// and what the robot hides is known.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "berth/sensor/settings.hpp"
#include "lab/trust/trial.hpp"

namespace berth::lab {

struct RealImage {
  std::string name;
  Camera camera;
  DepthImage depth_m;
};

/// Those of the folder `depth` of the real recordings: a person (RealSense-like), a room (RealSense
/// D435), a cylinder on the floor (Kinect), an office (Kinect). Throws std::runtime_error where one
/// is missing.
std::vector<RealImage> load_real_images(const std::filesystem::path& folder);

/// A robot in a real image.
struct RealScene {
  const RealImage* image = nullptr;
  const TrialRobot* robot = nullptr;
  RobotImage robot_image;
  /// Robot or scene, whatever is nearer, with noise on the robot.
  DepthImage depth_m;
  /// The scene where the robot does not hide it: what an ideal self filter leaves.
  DepthImage obstacle_depth_m;
  /// To the latter.
  LinkDistances ideal;
};

/// No link that is seen comes nearer to the scene than this: nearer things are part of what
/// tolerance and padding remove.
inline constexpr double kRealClearance_m = 0.06;

/// Random joints, place and turn. Nothing where the robot comes too near to the scene, or shows
/// less than 1 % of the image. Depends on its arguments alone.
std::optional<RealScene> draw_into(const RealImage& image, const TrialRobot& robot,
                                   std::uint32_t seed);

/// The rules that such an image goes through.
struct RealImageRules {
  std::string name;
  SelfFilterSettings self_filter = {};
  SensorSettings sensor = {};
  /// Whether the rejected distance counts where there is one (LinkVisibility).
  bool counts_rejected = false;
};
/// In the order of the table.
std::vector<RealImageRules> all_real_image_rules();
/// [i] is that of the link with the id i + 1. A background is learned from the image without the
/// robot.
std::vector<Estimate> estimate(const RealScene& scene, const RealImageRules& rules);

/// As Markdown: how much farther than the ideal filter's the distances of `scenes` such scenes are
/// (each image and robot in turn), under the self filter alone and with each sensor rule.
std::string real_image_table(const std::vector<RealImage>& images,
                             const std::vector<TrialRobot>& robots, int scenes);

}  // namespace berth::lab
