#include "berth/self_filter/islands.hpp"

#include <algorithm>
#include <iterator>

#include "berth/self_filter/joined.hpp"

namespace berth {
namespace {

/// Pieces of pixels marked `island`, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, const RobotImage& robot, const Tolerance& tolerance, float jump_m,
       IslandWorkspace& workspace, ObstacleImage& out)
      : depth_m_(depth_m),
        jump_m_(jump_m),
        walked_(workspace.walked),
        piece_(workspace.piece),
        seam_(depth_m, robot, tolerance, jump_m, out.fate, workspace.seam),
        out_(out) {}

  void through(const PixelRect& pixels) {
    for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
      for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
        if (out_.fate(u, v) == PixelFate::island && walked_(u, v) == 0) from({u, v});
      }
    }
  }

 private:
  void from(Pixel start) {
    piece_.assign(1, start);
    walked_(start.u, start.v) = 1;
    bool leaves = false;
    for (std::size_t next = 0; next < piece_.size(); ++next) leaves |= visit_around(piece_[next]);
    if (!leaves && hangs()) return;
    for (const Pixel& p : piece_) {
      out_.fate(p.u, p.v) = PixelFate::obstacle;
      out_.depth_m(p.u, p.v) = depth_m_(p.u, p.v);
    }
    out_.count[static_cast<std::size_t>(PixelFate::obstacle)] += std::ssize(piece_);
    out_.count[static_cast<std::size_t>(PixelFate::island)] -= std::ssize(piece_);
  }

  /// True where a joined neighbour is an obstacle elsewhere. Obstacles of pieces that were walked
  /// before are joined to none of this one.
  bool visit_around(Pixel p) {
    bool leaves = false;
    const float depth_m = depth_m_(p.u, p.v);
    for (int v = std::max(0, p.v - 1); v <= std::min(depth_m_.height - 1, p.v + 1); ++v) {
      for (int u = std::max(0, p.u - 1); u <= std::min(depth_m_.width - 1, p.u + 1); ++u) {
        if (!is_joined(depth_m_(u, v), depth_m, jump_m_)) continue;
        const PixelFate fate = out_.fate(u, v);
        leaves |= fate == PixelFate::obstacle;
        if (fate != PixelFate::island || walked_(u, v) != 0) continue;
        walked_(u, v) = 1;
        piece_.push_back({u, v});
      }
    }
    return leaves;
  }

  bool hangs() {
    return std::any_of(piece_.begin(), piece_.end(),
                       [this](const Pixel& p) { return seam_.leads_to(p); });
  }

  DepthView depth_m_;
  float jump_m_;
  Image<std::uint8_t>& walked_;
  std::vector<Pixel>& piece_;
  Seam seam_;
  ObstacleImage& out_;
};

}  // namespace

void keep_islands(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                  float jump_m, IslandWorkspace& workspace, ObstacleImage& out) {
  const PixelRect pixels = workspace.neighbourhood.grown_pixels();
  Walk(sensor_depth_m, robot, tolerance, jump_m, workspace, out).through(pixels);
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    std::fill(workspace.walked.row(v) + pixels.u_begin, workspace.walked.row(v) + pixels.u_end, 0);
  }
}

}  // namespace berth
