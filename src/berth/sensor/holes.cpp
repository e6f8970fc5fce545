#include "berth/sensor/holes.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "berth/sensor/background.hpp"

namespace berth {
namespace {

/// Cameras lose spots of at most 2 cm on a robot that they read: a larger one is before it
/// (docs/sensors.md).
constexpr double kBallOnLink_m = 0.04;
/// Any, since the robot covers all depths.
constexpr float kLost_m = 1;

bool is_link(LinkId id) { return id != kNoLink && id != kEnvironmentLink; }

/// Marks the pixels without a reading that the camera could read: links, too, wherever they are.
/// False: there are none.
bool find_lost(DepthView sensor_depth_m, const RobotImage& robot, const KnownPlace& place,
               const SensorSettings& settings, DepthImage& lost_m) {
  const Background* const background =
      place.background && place.background->is_of(sensor_depth_m.width, sensor_depth_m.height)
          ? place.background
          : nullptr;
  if (!background && !place.always_reads) return false;
  lost_m.resize(sensor_depth_m.width, sensor_depth_m.height, kNoDepth);
  std::atomic<bool> has_any = false;
  tbb::parallel_for(0, sensor_depth_m.height, [&](int v) {
    bool has_lost = false;
    for (int u = 0; u < sensor_depth_m.width; ++u) {
      if (!std::isnan(sensor_depth_m(u, v))) continue;
      const LinkId id = robot.link_id(u, v);
      const bool is_lost = is_link(id) || (place.always_reads && id == kNoLink) ||
                           (background && !std::isnan(background->depth_m(u, v, settings)));
      if (is_lost) lost_m(u, v) = kLost_m;
      has_lost = has_lost || is_lost;
    }
    if (has_lost) has_any = true;
  });
  return has_any;
}

/// What is lost on the links themselves.
class LostOnLinks {
 public:
  LostOnLinks(const Camera& camera, const RobotImage& robot, HolesWorkspace& workspace)
      : ball_px_(static_cast<float>(std::min(camera.fx_px, camera.fy_px) * kBallOnLink_m / 2)),
        robot_(robot),
        lost_m_(workspace.lost_m),
        read_surplus_(workspace.read_surplus) {
    count();
  }

  void mark(ObstacleImage& out) const {
    for_links([&](int u, int v) {
      if (is_lost(u, v) && for_ball(u, v, [&](int x, int y) { return is_lost(x, y); })) {
        for_ball(u, v, [&](int x, int y) {
          out.fate(x, y) = PixelFate::hole;
          return true;
        });
      }
    });
  }

 private:
  template <class Visit>
  void for_links(const Visit& visit) const {
    const PixelRect rect = clip(robot_.extent, lost_m_.width(), lost_m_.height());
    for (int v = rect.v_begin; v < rect.v_end; ++v) {
      for (int u = rect.u_begin; u < rect.u_end; ++u) {
        if (is_link(robot_.link_id(u, v))) visit(u, v);
      }
    }
  }

  /// A link that gives readings in less than half of its pixels is black itself.
  void count() {
    read_surplus_.clear();
    for_links([&](int u, int v) {
      const LinkId id = robot_.link_id(u, v);
      if (id >= read_surplus_.size()) read_surplus_.resize(id + std::size_t{1}, 0);
      read_surplus_[id] += std::isnan(lost_m_(u, v)) ? 1 : -1;
    });
  }

  bool is_lost(int u, int v) const {
    const LinkId id = robot_.link_id(u, v);
    return !std::isnan(lost_m_(u, v)) && is_link(id) && read_surplus_[id] > 0;
  }

  /// Until it does not hold for a pixel that a ball at the link's depth covers; false beside the
  /// image.
  template <class Holds>
  bool for_ball(int u, int v, const Holds& holds) const {
    const float radius_px = std::max(kLeastBall_px, ball_px_ / robot_.depth_m(u, v));
    const int reach_px = static_cast<int>(radius_px);
    for (int y = -reach_px; y <= reach_px; ++y) {
      for (int x = -reach_px; x <= reach_px; ++x) {
        if (static_cast<float>(x * x + y * y) > radius_px * radius_px) continue;
        const bool is_inside =
            u + x >= 0 && v + y >= 0 && u + x < lost_m_.width() && v + y < lost_m_.height();
        if (!is_inside || !holds(u + x, v + y)) return false;
      }
    }
    return true;
  }

  static constexpr float kLeastBall_px = 2;

  float ball_px_;
  const RobotImage& robot_;
  const DepthImage& lost_m_;
  std::vector<int>& read_surplus_;
};

}  // namespace

void find_holes(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                const KnownPlace& place, const SensorSettings& settings, HolesWorkspace& workspace,
                ObstacleImage& out) {
  if (!find_lost(sensor_depth_m, robot, place, settings, workspace.lost_m)) return;
  const Image<PixelFate>& beside =
      find_beside_robot(camera, workspace.lost_m, robot, kRobotShadow_m, workspace.beside_robot);
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    for (int u = 0; u < out.fate.width(); ++u) {
      if (beside(u, v) == PixelFate::obstacle) out.fate(u, v) = PixelFate::hole;
    }
  });
  LostOnLinks(camera, robot, workspace).mark(out);
}

}  // namespace berth
