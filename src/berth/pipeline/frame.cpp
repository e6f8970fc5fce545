#include "berth/pipeline/frame.hpp"

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

Frame::Frame() : space(std::make_unique<FrameSpace>()) {}
Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(Frame&&) noexcept = default;

void clear_images(const Camera& camera, Frame& frame) {
  const int width = camera.width_px, height = camera.height_px;
  frame.robot.depth_m.resize(width, height, kNoDepth);
  frame.robot.link_id.resize(width, height, kNoLink);
  frame.robot.extent = {};
  frame.obstacles.depth_m.resize(width, height, kNoDepth);
  frame.obstacles.fate.resize(width, height, PixelFate::no_reading);
  frame.obstacles.count = {};
  frame.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)] = width * height;
  frame.tells_unread = false;
  frame.unread_share = std::numeric_limits<double>::quiet_NaN();
  clear_rejected(width, height, frame.space->rejected);
  clear_space(*frame.space);
}

}  // namespace berth
