#include "berth/self_filter/islands.hpp"

#include <cmath>

namespace berth {
namespace {

/// What is known of an obstacle pixel while pieces are walked; find_near writes the first two.
enum State : std::uint8_t { kOutside, kInside, kWalked };

/// A piece that begins beside the robot may have a few pixels in front of its rim, where the model
/// is a little off. With more than this share there it is something that stands in front of the
/// robot.
constexpr double kMostInFront = 0.1;

/// Pieces of pixels in the robot's neighbourhood, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, const RobotImage& robot, float jump_m, IslandWorkspace& workspace,
       Image<PixelFate>& fate)
      : depth_m_(depth_m),
        robot_(robot),
        jump_m_(jump_m),
        state_(workspace.state),
        piece_(workspace.piece),
        fate_(fate) {}

  /// The piece that holds `start` is an island unless it is joined to an obstacle pixel outside, or
  /// stands in front.
  void from(Pixel start) {
    piece_.assign(1, start);
    state_(start.u, start.v) = kWalked;
    bool leaves = false;
    std::size_t in_front = 0;
    for (std::size_t next = 0; next < piece_.size(); ++next) {
      leaves |= visit_neighbours(piece_[next]);
      in_front += is_in_front(piece_[next]);
    }
    if (leaves || static_cast<double>(in_front) > kMostInFront * static_cast<double>(piece_.size()))
      return;
    for (const Pixel& p : piece_) fate_(p.u, p.v) = PixelFate::island;
  }

 private:
  bool is_in_front(Pixel p) const {
    const LinkId id = robot_.link_id(p.u, p.v);
    return id != kNoLink && id != kEnvironmentLink;
  }

  /// True where a joined neighbour is an obstacle pixel outside the robot's neighbourhood.
  bool visit_neighbours(Pixel p) {
    bool leaves = false;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const Pixel n{p.u + du, p.v + dv};
        if (n.u < 0 || n.u >= depth_m_.width || n.v < 0 || n.v >= depth_m_.height) continue;
        if (fate_(n.u, n.v) != PixelFate::obstacle) continue;
        if (std::abs(depth_m_(n.u, n.v) - depth_m_(p.u, p.v)) > jump_m_) continue;
        if (state_(n.u, n.v) == kOutside) leaves = true;
        if (state_(n.u, n.v) != kInside) continue;
        state_(n.u, n.v) = kWalked;
        piece_.push_back(n);
      }
    }
    return leaves;
  }

  DepthView depth_m_;
  const RobotImage& robot_;
  float jump_m_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& piece_;
  Image<PixelFate>& fate_;
};

}  // namespace

void mark_islands(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, IslandWorkspace& workspace,
                  Image<PixelFate>& fate) {
  workspace.neighbourhood.build(camera, robot);
  workspace.neighbourhood.find_near(sensor_depth_m, fate, settings.island_radius_m,
                                    workspace.state);
  Walk walk(sensor_depth_m, robot, static_cast<float>(settings.island_jump_m), workspace, fate);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (workspace.state(u, v) == kInside) walk.from({u, v});
    }
  }
}

}  // namespace berth
