#include "berth/self_filter/flying_patches.hpp"

#include "berth/self_filter/joined.hpp"
#include "berth/self_filter/seam.hpp"

namespace berth {
namespace {

enum State : std::uint8_t { kUnknown, kInPiece, kStays };

/// Pieces of obstacles, walked one by one.
class Walk {
 public:
  Walk(DepthView depth_m, float jump_m, FlyingPatchWorkspace& workspace, ObstacleImage& out)
      : depth_m_(depth_m),
        jump_m_(jump_m),
        neighbourhood_(workspace.neighbourhood),
        state_(workspace.state),
        walked_(workspace.walked),
        open_(workspace.open),
        out_(out) {}
  ~Walk() {
    for (const Pixel& p : walked_) state_(p.u, p.v) = kUnknown;
    walked_.clear();
  }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  bool has_seen(Pixel p) const { return state_(p.u, p.v) != kUnknown; }

  /// Walks the piece that begins at this obstacle, which was not seen, and drops it unless it
  /// stays.
  void from(Pixel start) {
    const std::size_t first = walked_.size();
    const bool stays = leaves(start);
    open_.clear();
    for (std::size_t i = first; i < walked_.size(); ++i) {
      const Pixel& p = walked_[i];
      if (stays)
        state_(p.u, p.v) = kStays;
      else
        drop(p);
    }
  }

 private:
  /// Deep before wide, which is out of the neighbourhood soonest.
  bool leaves(Pixel start) {
    add(start);
    while (!open_.empty()) {
      const Pixel p = open_.back();
      open_.pop_back();
      if (!neighbourhood_.holds(p, depth_m_, out_.fate) || touches_what_stays(p)) return true;
    }
    return false;
  }

  void add(Pixel p) {
    state_(p.u, p.v) = kInPiece;
    walked_.push_back(p);
    open_.push_back(p);
  }

  /// Adds the neighbours that are joined; true where one is known to stay.
  bool touches_what_stays(Pixel p) {
    const auto is_obstacle = [this](Pixel q) { return out_.fate(q.u, q.v) == PixelFate::obstacle; };
    return any_joined(depth_m_, p, jump_m_, is_obstacle, [this](Pixel q) {
      if (state_(q.u, q.v) == kUnknown) add(q);
      return state_(q.u, q.v) == kStays;
    });
  }

  void drop(Pixel p) {
    out_.fate(p.u, p.v) = PixelFate::flying_patch;
    out_.depth_m(p.u, p.v) = kNoDepth;
    --out_.count[static_cast<std::size_t>(PixelFate::obstacle)];
    ++out_.count[static_cast<std::size_t>(PixelFate::flying_patch)];
  }

  DepthView depth_m_;
  float jump_m_;
  Neighbourhood& neighbourhood_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& walked_;
  std::vector<Pixel>& open_;
  ObstacleImage& out_;
};

}  // namespace

void drop_flying_patches(DepthView sensor_depth_m, const RobotImage& robot,
                         const Tolerance& tolerance, float jump_m, FlyingPatchWorkspace& workspace,
                         ObstacleImage& out) {
  workspace.seam.clear();
  append_seam(sensor_depth_m, robot, tolerance, jump_m, out.fate, workspace.state, workspace.seam);
  Walk walk(sensor_depth_m, jump_m, workspace, out);
  for (const Pixel& p : workspace.seam) {
    if (out.fate(p.u, p.v) == PixelFate::obstacle && !walk.has_seen(p)) walk.from(p);
  }
}

}  // namespace berth
