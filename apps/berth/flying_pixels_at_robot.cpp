#include "apps/berth/flying_pixels_at_robot.hpp"

#include <cmath>
#include <queue>

#include "berth/fit/robot_pixels.hpp"

namespace berth::app {
namespace {

constexpr double kReach_m = 0.05;
constexpr float kLikeRobot_m = 0.05F;
/// Two frames show the same thing up to this.
constexpr float kSame_m = 0.03F;

/// Things stand still: at least half of the other frames show them. The robot may have been here in
/// some.
bool is_environment(const CalibrationCamera& camera, std::size_t frame, Pixel p) {
  const float reading_m = camera.frames[frame].depth_m(p.u, p.v);
  std::size_t same = 0;
  for (std::size_t k = 0; k < camera.frames.size(); ++k) {
    same += k != frame && std::abs(camera.frames[k].depth_m(p.u, p.v) - reading_m) <= kSame_m;
  }
  return same > 0 && 2 * same >= camera.frames.size() - 1;
}

bool is_inside(const Image<LinkId>& ids, Pixel p) {
  return p.u >= 0 && p.v >= 0 && p.u < ids.width() && p.v < ids.height();
}

}  // namespace

Image<std::uint8_t> flying_pixels_at_robot(const CalibrationCamera& camera, std::size_t frame,
                                           const RobotImage& robot) {
  const Image<LinkId>& ids = robot.link_id;
  Image<std::uint8_t> flying(ids.width(), ids.height(), 0);
  // Outwards from the outline, ring by ring; each pixel keeps the pixel of the robot it came from.
  Image<Pixel> origin(ids.width(), ids.height());
  std::queue<Pixel> ring;
  for (int v = 0; v < ids.height(); ++v) {
    for (int u = 0; u < ids.width(); ++u) {
      if (!is_robot(ids(u, v))) continue;
      origin(u, v) = {u, v};
      ring.push({u, v});
    }
  }
  for (; !ring.empty(); ring.pop()) {
    const Pixel p = ring.front(), from = origin(p.u, p.v);
    const float z_m = robot.depth_m(from.u, from.v);
    for (const Pixel step : {Pixel{1, 0}, Pixel{-1, 0}, Pixel{0, 1}, Pixel{0, -1}}) {
      const Pixel q{p.u + step.u, p.v + step.v};
      if (!is_inside(ids, q) || origin(q.u, q.v) != Pixel{} || ids(q.u, q.v) != kNoLink) continue;
      if (std::hypot(q.u - from.u, q.v - from.v) * z_m > kReach_m * camera.camera.fx_px) continue;
      origin(q.u, q.v) = from;
      ring.push(q);
      const bool like_robot =
          std::abs(camera.frames[frame].depth_m(q.u, q.v) - z_m) <= kLikeRobot_m;
      flying(q.u, q.v) = like_robot && !is_environment(camera, frame, q);
    }
  }
  return flying;
}

}  // namespace berth::app
