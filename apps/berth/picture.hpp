// The picture of one frame: what the camera saw, what was filtered out of it, and how near each
// link is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "berth/pipeline/result.hpp"
#include "berth/types/image.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth::app {

/// A link with its pair's pixels in one image.
struct PictureLink : LinkResult {
  Pixel robot_pixel;
};

/// What write_picture() draws. A pair whose pixels are not in the image is not drawn. A null
/// pointer leaves that layer out; the images have the sensor's size.
struct PictureInput {
  DepthView sensor_depth_m;
  const RobotImage* robot = nullptr;
  const ObstacleImage* obstacles = nullptr;
  /// links[i] has the id i + 1; the pixels of its pair are those of this image. Names are UTF-8.
  const std::vector<PictureLink>* links = nullptr;
  /// Distances were looked for up to here.
  double range_m = 0;
  std::string title = {};
};

/// Writes a PNG: the depth image with the robot, the filtered pixels and each link's closest pair
/// on it, and a legend at its right. The file appears complete or not at all. Throws
/// std::runtime_error with the path and the reason: no pixels, images or names that do not fit
/// together, text that is not UTF-8, a file that cannot be written.
void write_picture(const std::filesystem::path& path, const PictureInput& input);

}  // namespace berth::app
