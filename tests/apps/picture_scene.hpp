// A made-up frame to draw: an arm on a table, boxes, a person, holes in the depth image.
#pragma once

#include "apps/berth/picture.hpp"

namespace berth::app {

struct PictureScene {
  DepthImage sensor_depth_m;
  RobotImage robot;
  ObstacleImage obstacles;
  std::vector<PictureLink> links;

  /// With pointers into this scene.
  PictureInput input() const;
};

/// The first link is said to have nothing within the range; the last one is not in the image.
PictureScene make_picture_scene(int width_px, int height_px, int links);

}  // namespace berth::app
