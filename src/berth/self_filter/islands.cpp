#include "berth/self_filter/islands.hpp"

#include <algorithm>
#include <cmath>

namespace berth {
namespace {

// What is known of a pixel while pieces are walked.
enum State : std::uint8_t { kOutside, kInside, kWalked };

/// Pieces of pixels, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, const PixelRect& rect, float jump_m, IslandWorkspace& workspace,
       Image<PixelFate>& fate)
      : depth_m_(depth_m), rect_(rect), jump_m_(jump_m), workspace_(workspace), fate_(fate) {}

  /// The piece that holds `start` is an island unless it is joined to an obstacle pixel outside.
  void from(Pixel start) {
    auto& piece = workspace_.piece;
    piece.assign(1, start);
    state(start) = kWalked;
    bool leaves = false;
    for (std::size_t next = 0; next < piece.size(); ++next) leaves |= visit_neighbours(piece[next]);
    if (leaves) return;
    for (const Pixel& p : piece) fate_(p.u, p.v) = PixelFate::island;
  }

 private:
  std::uint8_t& state(Pixel p) {
    return workspace_.state(p.u - rect_.u_begin, p.v - rect_.v_begin);
  }
  bool in_rect(Pixel p) const {
    return p.u >= rect_.u_begin && p.u < rect_.u_end && p.v >= rect_.v_begin && p.v < rect_.v_end;
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
        if (!in_rect(n) || state(n) == kOutside) {
          leaves = true;
        } else if (state(n) == kInside) {
          state(n) = kWalked;
          workspace_.piece.push_back(n);
        }
      }
    }
    return leaves;
  }

  DepthView depth_m_;
  PixelRect rect_;
  float jump_m_;
  IslandWorkspace& workspace_;
  Image<PixelFate>& fate_;
};

}  // namespace

void mark_islands(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                  const SelfFilterSettings& settings, IslandWorkspace& workspace,
                  Image<PixelFate>& fate) {
  RobotNeighbourhood& neighbourhood = workspace.neighbourhood;
  neighbourhood.build(camera, robot);
  const PixelRect rect = neighbourhood.reach(settings.island_radius_m);
  if (rect.empty()) return;
  workspace.state.resize(rect.u_end - rect.u_begin, rect.v_end - rect.v_begin, kOutside);
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      const bool in_front_of_robot =
          robot.link_id(u, v) != kNoLink && robot.link_id(u, v) != kEnvironmentLink;
      if (fate(u, v) != PixelFate::obstacle || in_front_of_robot) continue;
      if (neighbourhood.is_near(u, v, sensor_depth_m(u, v), settings.island_radius_m)) {
        workspace.state(u - rect.u_begin, v - rect.v_begin) = kInside;
      }
    }
  }
  Walk walk(sensor_depth_m, rect, static_cast<float>(settings.island_jump_m), workspace, fate);
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      if (workspace.state(u - rect.u_begin, v - rect.v_begin) == kInside) walk.from({u, v});
    }
  }
}

}  // namespace berth
