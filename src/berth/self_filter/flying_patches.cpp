#include "berth/self_filter/flying_patches.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "berth/self_filter/joined.hpp"
#include "berth/self_filter/settings.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {
namespace {

PixelRect with_border(const PixelRect& rect, const Image<PixelFate>& fate) {
  const PixelRect inside = clip(rect, fate.width(), fate.height());
  return clip({inside.u_begin - 1, inside.v_begin - 1, inside.u_end + 1, inside.v_end + 1},
              fate.width(), fate.height());
}

/// Appends the obstacles that the robot's own readings lead to, and the pixels between. Own are the
/// readings on the model's surface: fate `robot`, and not behind it by more than the tolerance.
/// They lead to a pixel beside it by steps to neighbours (8) that are joined (joined.hpp), from
/// pixel to pixel of what was dropped there as `padding`. What stands behind the
/// robot, or before it, is a step away from its readings. `is_found` is 0 everywhere, before and
/// after.
void append_seam(DepthView sensor_depth_m, const RobotImage& robot, const Tolerance& tolerance,
                 const Image<PixelFate>& fate, Image<std::uint8_t>& is_found,
                 std::vector<Pixel>& seam) {
  const auto shows_robot = [&](Pixel q) { return fate(q.u, q.v) == PixelFate::robot; };
  const auto is_on_model = [&](Pixel q) {
    return sensor_depth_m(q.u, q.v) <= tolerance.greatest_reading_m(robot.depth_m(q.u, q.v));
  };
  const auto may_be_next = [&](Pixel q) {
    const PixelFate f = fate(q.u, q.v);
    return is_found(q.u, q.v) == 0 && (f == PixelFate::padding || f == PixelFate::obstacle);
  };
  const auto append = [&](Pixel q) {
    is_found(q.u, q.v) = 1;
    seam.push_back(q);
    return false;
  };

  append_beside_robot(fate, with_border(robot.extent, fate), seam);
  const auto hangs = [&](Pixel p) {
    return any_joined(sensor_depth_m, p, shows_robot, is_on_model);
  };
  seam.erase(std::remove_if(seam.begin(), seam.end(),
                            [&](Pixel p) {
                              if (is_found(p.u, p.v) != 0 || !hangs(p)) return true;
                              is_found(p.u, p.v) = 1;
                              return false;
                            }),
             seam.end());
  for (std::size_t i = 0; i < seam.size(); ++i) {
    const Pixel p = seam[i];
    if (fate(p.u, p.v) == PixelFate::padding) any_joined(sensor_depth_m, p, may_be_next, append);
  }
  for (const Pixel& p : seam) is_found(p.u, p.v) = 0;
}

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

void Neighbourhood::begin(const Camera& camera, const RobotImage& robot,
                          const SelfFilterSettings& settings, const Outline& outline) {
  grown_.begin(camera, robot, settings, outline, PixelFate::flying_patch);
  outline_ = &outline;
  grid_ = tiles_of(camera);
  has_discs_ = false;
  is_found_.assign(grid_.count(), 0);
  near_.resize(grid_.count());
}

bool Neighbourhood::holds(Pixel p, DepthView sensor_depth_m, const Image<PixelFate>& fate) {
  if (!has_discs_) make_discs();
  const int column = p.u / kTileWidth_px;
  const int row = p.v / kTileHeight_px;
  const std::size_t tile = grid_.index(column, row);
  if (is_found_[tile] == 0) {
    near_[tile] = grown_.covered(column, row, sensor_depth_m, fate);
    is_found_[tile] = 1;
  }
  return (near_[tile][p.v % kTileHeight_px] >> (p.u % kTileWidth_px) & 1) != 0;
}

void Neighbourhood::make_discs() {
  for (int row = outline_->tiles().v_begin; row < outline_->tiles().v_end; ++row)
    grown_.make_discs(row);
  grown_.end_discs();
  has_discs_ = true;
}

}  // namespace berth
