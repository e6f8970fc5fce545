#include "berth/sensor/sensor_rules.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "berth/self_filter/joined.hpp"

namespace berth {

std::string_view SensorSettings::first_rule() const {
  if (drops_speckle()) return "speckle_px";
  if (has_background()) return "background_frames";
  return {};
}

void validate(const SensorSettings& settings) { visit_settings(settings, SettingCheck{"sensor"}); }

namespace {

enum State : std::uint8_t { kUnknown, kWalked, kLarge };

/// A walk ends once the blob is large enough, so most pixels are settled by a neighbour that is
/// known to be part of a large one.
class Walk {
 public:
  Walk(const SensorSettings& settings, SpeckleWorkspace& workspace, ObstacleImage& out)
      : least_size_(static_cast<std::size_t>(settings.speckle_px)),
        state_(workspace.state),
        blob_(workspace.blob),
        out_(out) {}

  void settle(Pixel start) {
    if (is_joined_to_large_on_the_left(start)) {
      state_(start.u, start.v) = kLarge;
      return;
    }
    const bool large = is_large(start);
    for (const Pixel& p : blob_) {
      state_(p.u, p.v) = large ? kLarge : kWalked;
      if (large) continue;
      out_.fate(p.u, p.v) = PixelFate::speckle;
      out_.depth_m(p.u, p.v) = kNoDepth;
    }
  }

 private:
  bool is_joined_to_large_on_the_left(Pixel p) const {
    return p.u > 0 && state_(p.u - 1, p.v) == kLarge && is_joined(p, {p.u - 1, p.v});
  }

  bool is_large(Pixel start) {
    blob_.assign(1, start);
    state_(start.u, start.v) = kWalked;
    for (std::size_t next = 0; next < blob_.size(); ++next) {
      if (blob_.size() >= least_size_ || visit_neighbours(blob_[next])) return true;
    }
    return false;
  }

  /// True where a joined neighbour is part of a large blob.
  bool visit_neighbours(Pixel p) {
    for (int v = std::max(0, p.v - 1); v <= std::min(state_.height() - 1, p.v + 1); ++v) {
      for (int u = std::max(0, p.u - 1); u <= std::min(state_.width() - 1, p.u + 1); ++u) {
        std::uint8_t& state = state_(u, v);
        if (state == kWalked || out_.fate(u, v) != PixelFate::obstacle || !is_joined(p, {u, v}))
          continue;
        if (state == kLarge) return true;
        state = kWalked;
        blob_.push_back({u, v});
      }
    }
    return false;
  }

  bool is_joined(Pixel a, Pixel b) const {
    return berth::is_joined(out_.depth_m(a.u, a.v), out_.depth_m(b.u, b.v));
  }

  std::size_t least_size_;
  Image<std::uint8_t>& state_;
  std::vector<Pixel>& blob_;
  ObstacleImage& out_;
};

}  // namespace

void drop_speckle(const SensorSettings& settings, SpeckleWorkspace& workspace, ObstacleImage& out) {
  workspace.state.resize(out.fate.width(), out.fate.height(), kUnknown);
  Walk walk(settings, workspace, out);
  for (int v = 0; v < out.fate.height(); ++v) {
    for (int u = 0; u < out.fate.width(); ++u) {
      if (out.fate(u, v) == PixelFate::obstacle && workspace.state(u, v) == kUnknown)
        walk.settle({u, v});
    }
  }
}

namespace {

void count_again(ObstacleImage& out) {
  std::array<std::atomic<std::int64_t>, kPixelFateCount> total{};
  tbb::parallel_for(0, out.fate.height(), [&](int v) {
    std::array<int, kPixelFateCount> count{};
    for (int u = 0; u < out.fate.width(); ++u) ++count[static_cast<std::size_t>(out.fate(u, v))];
    for (std::size_t fate = 0; fate < count.size(); ++fate) total[fate] += count[fate];
  });
  for (std::size_t fate = 0; fate < total.size(); ++fate) out.count[fate] = total[fate];
}

}  // namespace

void apply_sensor_rules(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                        const KnownPlace& place, const SensorSettings& settings,
                        SensorWorkspace& workspace, ObstacleImage& out) {
  if (settings.first_rule().empty() && !place.always_reads) return;
  const bool has_background = settings.has_background() && place.background;
  if (settings.drops_speckle()) drop_speckle(settings, workspace.speckle, out);
  if (has_background) place.background->complete(sensor_depth_m, place, settings, out);
  if (has_background || place.always_reads) {
    find_holes(camera, sensor_depth_m, robot, place, settings, workspace.holes, out);
  }
  count_again(out);
}

}  // namespace berth
