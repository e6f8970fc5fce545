#include "berth/self_filter/islands.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace berth {
namespace {

/// find_near writes the first two.
enum State : std::uint8_t { kOutside, kInside, kWalked };

/// A piece that begins beside the robot may have a few pixels in front of its rim, where the model
/// is a little off. With more than this share there it is something that stands in front of the
/// robot.
constexpr double kMostInFront = 0.1;

/// Pieces of pixels in the robot's neighbourhood, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, const RobotImage& robot, const Tolerance& tolerance, float jump_m,
       IslandWorkspace& workspace, ObstacleImage& out)
      : depth_m_(depth_m),
        robot_(robot),
        jump_m_(jump_m),
        state_(workspace.state),
        piece_(workspace.piece),
        seam_(depth_m, robot, tolerance, jump_m, out.fate, workspace.seam),
        out_(out) {}

  void through(const PixelRect& tile) {
    for (int v = tile.v_begin; v < tile.v_end; ++v) {
      for (int u = tile.u_begin; u < tile.u_end; ++u) {
        if (state_(u, v) == kInside) from({u, v});
      }
    }
  }

 private:
  /// The piece that holds `start` is an island unless it is joined to an obstacle pixel outside,
  /// stands in front, or does not hang on the robot.
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
    if (!hangs()) return;
    for (const Pixel& p : piece_) {
      out_.fate(p.u, p.v) = PixelFate::island;
      out_.depth_m(p.u, p.v) = kNoDepth;
    }
    out_.count[static_cast<std::size_t>(PixelFate::obstacle)] -= std::ssize(piece_);
    out_.count[static_cast<std::size_t>(PixelFate::island)] += std::ssize(piece_);
  }

  bool hangs() {
    return std::any_of(piece_.begin(), piece_.end(),
                       [this](const Pixel& p) { return seam_.leads_to(p); });
  }

  bool is_in_front(Pixel p) const {
    const LinkId id = robot_.link_id(p.u, p.v);
    return id != kNoLink && id != kEnvironmentLink;
  }

  /// True where a joined neighbour is an obstacle pixel outside the robot's neighbourhood.
  bool visit_neighbours(Pixel p) {
    bool leaves = false;
    const float depth_m = depth_m_(p.u, p.v);
    for (int v = std::max(0, p.v - 1); v <= std::min(depth_m_.height - 1, p.v + 1); ++v) {
      for (int u = std::max(0, p.u - 1); u <= std::min(depth_m_.width - 1, p.u + 1); ++u) {
        std::uint8_t& state = state_(u, v);
        if (state == kWalked || out_.fate(u, v) != PixelFate::obstacle) continue;
        if (std::abs(depth_m_(u, v) - depth_m) > jump_m_) continue;
        if (state == kOutside) {
          leaves = true;
        } else {
          state = kWalked;
          piece_.push_back({u, v});
        }
      }
    }
    return leaves;
  }

  DepthView depth_m_;
  const RobotImage& robot_;
  float jump_m_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& piece_;
  Seam seam_;
  ObstacleImage& out_;
};

template <class Call>
void for_near_tiles(const RobotNeighbourhood& neighbourhood, const Call& call) {
  for (int row = 0; row < neighbourhood.tile_rows(); ++row) {
    for (const PixelRect& tile : neighbourhood.near_tiles(row)) call(tile);
  }
}

}  // namespace

void drop_islands(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                  float jump_m, IslandWorkspace& workspace, ObstacleImage& out) {
  Walk walk(sensor_depth_m, robot, tolerance, jump_m, workspace, out);
  for_near_tiles(workspace.neighbourhood, [&](const PixelRect& tile) { walk.through(tile); });
  for_near_tiles(workspace.neighbourhood, [&](const PixelRect& tile) {
    for (int v = tile.v_begin; v < tile.v_end; ++v) {
      std::fill(workspace.state.row(v) + tile.u_begin, workspace.state.row(v) + tile.u_end,
                kOutside);
    }
  });
}

}  // namespace berth
