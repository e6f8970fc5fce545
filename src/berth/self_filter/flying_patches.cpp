#include "berth/self_filter/flying_patches.hpp"

#include <span>

#include "berth/self_filter/joined.hpp"
#include "berth/self_filter/seam.hpp"

namespace berth {
namespace {

/// The middle of plateaus (docs/self-filter-defaults.md): shares from 0.15 to 0.35, holes from 3 to
/// 5 mm.
constexpr float kLeastSharpShare = 0.25F;
constexpr int kLeastSharp = 10;
constexpr float kWidestHole_m = 0.004F;
constexpr float kWidestHole_px = 1.5F;
constexpr double kLeast_m2 = 1e-4;

/// kRim is a bit beside the others.
enum State : std::uint8_t { kUnknown, kInPiece, kStays, kSettled, kRim = 4 };

/// Pieces of obstacles, walked and judged one by one.
class Walk {
 public:
  Walk(const Camera& camera, DepthView depth_m, const std::vector<Pixel>& things,
       FlyingPatchWorkspace& workspace, ObstacleImage& out)
      : pixel_m2_(1 / (camera.fx_px * camera.fy_px)),
        focal_px_(static_cast<float>(std::min(camera.fx_px, camera.fy_px))),
        depth_m_(depth_m),
        neighbourhood_(workspace.neighbourhood),
        state_(workspace.state),
        walked_(workspace.walked),
        open_(workspace.open),
        rim_(workspace.rim),
        out_(out) {
    for (const Pixel& p : things) state_(p.u, p.v) = kStays;
    walked_ = things;
  }
  ~Walk() {
    for (const Pixel& p : walked_) state_(p.u, p.v) = kUnknown;
    walked_.clear();
  }
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;

  bool has_seen(Pixel p) const { return state_(p.u, p.v) != kUnknown; }

  /// Walks the piece that begins at this obstacle, which was not seen, and judges it.
  void from(Pixel start) {
    const std::size_t first = walked_.size();
    const bool leaves_it = leaves(start);
    open_.clear();
    const std::span<const Pixel> piece = std::span(walked_).subspan(first);
    const bool is_crumb = area_m2(piece) < kLeast_m2;
    const bool stays = leaves_it || (!is_crumb && is_thing(piece));
    for (const Pixel& p : piece) state_(p.u, p.v) = stays ? kStays : kSettled;
    if (stays) return;
    for (const Pixel& p : piece) drop(p, is_crumb ? PixelFate::speckle : PixelFate::flying_patch);
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
    return any_joined(depth_m_, p, is_obstacle, [this](Pixel q) {
      if (state_(q.u, q.v) == kUnknown) add(q);
      return state_(q.u, q.v) == kStays;
    });
  }

  double area_m2(std::span<const Pixel> piece) const {
    double sum = 0;
    for (const Pixel& p : piece) {
      const double z_m = depth_m_(p.u, p.v);
      sum += z_m * z_m * pixel_m2_;
    }
    return sum;
  }

  bool is_thing(std::span<const Pixel> piece) {
    find_rim(piece);
    const auto sharp = std::ranges::count_if(rim_, [this](Pixel p) { return is_sharp(p); });
    const bool is_enough =
        sharp >= kLeastSharp && static_cast<float>(sharp) >= kLeastSharpShare * rim_.size();
    for (const Pixel& p : rim_) state_(p.u, p.v) &= static_cast<std::uint8_t>(~kRim);
    return is_enough;
  }

  void find_rim(std::span<const Pixel> piece) {
    rim_.clear();
    for (const Pixel& p : piece) {
      for_square(p, 1, [this](Pixel q) {
        std::uint8_t& state = state_(q.u, q.v);
        if (state == kInPiece || (state & kRim) != 0 || shows_robot(q)) return;
        state |= kRim;
        rim_.push_back(q);
      });
    }
  }

  /// Whether the nearest foreign reading lies a step behind the piece, across hardly a hole.
  bool is_sharp(Pixel p) const {
    float piece_m = HUGE_VALF;
    for_square(p, 1, [&](Pixel q) {
      if (is_in_piece(q)) piece_m = std::min(piece_m, depth_m_(q.u, q.v));
    });
    const float hole_px = std::max(kWidestHole_px, kWidestHole_m * focal_px_ / piece_m);
    int nearest2_px2 = static_cast<int>(hole_px * hole_px);
    float beyond_m = kNoDepth;
    for_square(p, static_cast<int>(hole_px), [&](Pixel q) {
      const int off2_px2 = (q.u - p.u) * (q.u - p.u) + (q.v - p.v) * (q.v - p.v);
      const float z_m = depth_m_(q.u, q.v);
      if (off2_px2 > nearest2_px2 || !(z_m > 0) || is_in_piece(q) || shows_robot(q)) return;
      // Of those equally near the least deep one, so that the order does not matter.
      const bool is_nearer = off2_px2 < nearest2_px2 || std::isnan(beyond_m);
      beyond_m = is_nearer ? z_m : std::min(beyond_m, z_m);
      nearest2_px2 = off2_px2;
    });
    return beyond_m > piece_m + joined_step_m(piece_m);
  }

  template <class Visit>
  void for_square(Pixel p, int reach_px, const Visit& visit) const {
    for (int v = std::max(0, p.v - reach_px); v <= std::min(depth_m_.height - 1, p.v + reach_px);
         ++v) {
      for (int u = std::max(0, p.u - reach_px); u <= std::min(depth_m_.width - 1, p.u + reach_px);
           ++u) {
        visit(Pixel{u, v});
      }
    }
  }

  bool is_in_piece(Pixel p) const { return state_(p.u, p.v) == kInPiece; }
  bool shows_robot(Pixel p) const {
    const PixelFate fate = out_.fate(p.u, p.v);
    return fate == PixelFate::robot || fate == PixelFate::padding;
  }

  void drop(Pixel p, PixelFate fate) {
    out_.fate(p.u, p.v) = fate;
    out_.depth_m(p.u, p.v) = kNoDepth;
    --out_.count[static_cast<std::size_t>(PixelFate::obstacle)];
    ++out_.count[static_cast<std::size_t>(fate)];
  }

  /// What a pixel covers 1 m away.
  double pixel_m2_;
  float focal_px_;
  DepthView depth_m_;
  Neighbourhood& neighbourhood_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& walked_;
  std::vector<Pixel>& open_;
  std::vector<Pixel>& rim_;
  ObstacleImage& out_;
};

}  // namespace

void judge_flying_patches(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                          const Tolerance& tolerance, const std::vector<Pixel>& things,
                          FlyingPatchWorkspace& workspace, ObstacleImage& out) {
  workspace.seam.clear();
  append_seam(sensor_depth_m, robot, tolerance, out.fate, workspace.state, workspace.seam);
  Walk walk(camera, sensor_depth_m, things, workspace, out);
  for (const Pixel& p : workspace.seam) {
    if (out.fate(p.u, p.v) == PixelFate::obstacle && !walk.has_seen(p)) walk.from(p);
  }
}

}  // namespace berth
