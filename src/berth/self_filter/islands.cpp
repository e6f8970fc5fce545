#include "berth/self_filter/islands.hpp"

#include <cmath>

namespace berth {
namespace {

/// What is known of an obstacle pixel while pieces are walked; find_near writes the first two.
enum State : std::uint8_t { kOutside, kInside, kWalked };

/// Pieces of pixels in the robot's neighbourhood, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, float jump_m, IslandWorkspace& workspace, Image<PixelFate>& fate)
      : depth_m_(depth_m),
        jump_m_(jump_m),
        state_(workspace.state),
        piece_(workspace.piece),
        fate_(fate) {}

  /// The piece that holds `start` is an island unless it is joined to an obstacle pixel outside.
  void from(Pixel start) {
    piece_.assign(1, start);
    state_(start.u, start.v) = kWalked;
    bool leaves = false;
    for (std::size_t next = 0; next < piece_.size(); ++next)
      leaves |= visit_neighbours(piece_[next]);
    if (leaves) return;
    for (const Pixel& p : piece_) fate_(p.u, p.v) = PixelFate::island;
  }

 private:
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
  float jump_m_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& piece_;
  Image<PixelFate>& fate_;
};

}  // namespace

void mark_islands(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, IslandWorkspace& workspace,
                  Image<PixelFate>& fate) {
  workspace.candidate.resize(camera.width_px, camera.height_px, 0);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const LinkId id = robot.link_id(u, v);
      const bool in_front_of_robot = id != kNoLink && id != kEnvironmentLink;
      workspace.candidate(u, v) = fate(u, v) == PixelFate::obstacle && !in_front_of_robot;
    }
  }
  workspace.neighbourhood.build(camera, robot);
  workspace.neighbourhood.find_near(sensor_depth_m, workspace.candidate, settings.island_radius_m,
                                    workspace.state);
  Walk walk(sensor_depth_m, static_cast<float>(settings.island_jump_m), workspace, fate);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      if (workspace.state(u, v) == kInside) walk.from({u, v});
    }
  }
}

}  // namespace berth
