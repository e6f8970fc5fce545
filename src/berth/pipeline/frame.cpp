#include "berth/pipeline/frame.hpp"

namespace berth {

void clear_images(const Camera& camera, Frame& frame) {
  const int width = camera.width_px, height = camera.height_px;
  frame.robot.depth_m.resize(width, height, kNoDepth);
  frame.robot.link_id.resize(width, height, kNoLink);
  frame.robot.extent = {};
  frame.obstacles.depth_m.resize(width, height, kNoDepth);
  frame.obstacles.fate.resize(width, height, PixelFate::no_reading);
  frame.obstacles.count = {};
  frame.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)] = width * height;
  frame.searchable.build(frame.obstacles.depth_m);
  clear_doubtful(width, height, frame.doubtful);
  frame.space.obstacle_depth_m = {};
  frame.has_doubtful_space = false;
}

}  // namespace berth
