#include "berth/pipeline/frame.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/pipeline/frame_space.hpp"
#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

Frame::Frame() : space(std::make_unique<FrameSpace>()) {}
Frame::~Frame() = default;
Frame::Frame(Frame&&) noexcept = default;
Frame& Frame::operator=(Frame&&) noexcept = default;

bool Frame::is_for_any_query() const {
  return !view || time.status != TimeStatus::ok || !space->seen.is_empty();
}

void require_space(const Frame& frame) {
  if (frame.is_for_any_query()) return;
  throw std::invalid_argument(fmt::format(
      "frames: camera {}: observed for methods that compare images alone; expected a frame for "
      "any query",
      frame.view->mount().name));
}

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
