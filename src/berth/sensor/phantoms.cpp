#include "berth/sensor/phantoms.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth {
namespace {

/// Of the pixels that a ball covers.
constexpr double kLeastShare = 0.25;

/// The pixels of a row that may be alone: kept ones that are not within `d_m` in depth of so many
/// of their eight neighbours that nobody asks for more. All at the image's border may.
void append_doubtful(const float* above, const float* row, const float* below, int width, int v,
                     float d_m, std::vector<std::uint8_t>& is_near, std::vector<Pixel>& out) {
  is_near.assign(width, 0);
  const bool is_inside = above != nullptr && below != nullptr;
  std::uint8_t* __restrict const is_supported = is_near.data();
  for (int u = 1; is_inside && u + 1 < width; ++u) {
    const float z_m = row[u];
    const auto is_by = [=](float m) { return int(std::abs(m - z_m) <= d_m); };
    const int found = is_by(row[u - 1]) + is_by(row[u + 1]) + is_by(above[u - 1]) +
                      is_by(above[u]) + is_by(above[u + 1]) + is_by(below[u - 1]) +
                      is_by(below[u]) + is_by(below[u + 1]);
    is_supported[u] = static_cast<std::uint8_t>(int(found + 1 >= kMostSupport) | int(z_m != z_m));
  }
  for (int u = 0; u < width; ++u) {
    if (is_near[u] == 0 && !std::isnan(row[u])) out.push_back({u, v});
  }
}

/// Whether a reading may be of the thing that another one shows.
bool supports(PixelFate fate) { return fate != PixelFate::robot && fate != PixelFate::environment; }

/// Whether so many readings, itself among them, lie within d.
bool has_support(DepthView sensor_depth_m, const ObstacleImage& image, Pixel p, int reach_px,
                 float d_m, int wanted) {
  const float z_m = image.depth_m(p.u, p.v);
  int found = 0;
  const auto count = [&](int reach) {
    const PixelRect around = clip({p.u - reach, p.v - reach, p.u + reach + 1, p.v + reach + 1},
                                  sensor_depth_m.width, sensor_depth_m.height);
    found = 0;
    for (int v = around.v_begin; v < around.v_end && found < wanted; ++v) {
      const float* const sensed_m = sensor_depth_m.row(v);
      const float* const kept_m = image.depth_m.row(v);
      const PixelFate* const fate = image.fate.row(v);
      for (int u = around.u_begin; u < around.u_end; ++u) {
        const bool is_near = std::abs(kept_m[u] - z_m) <= d_m || std::abs(sensed_m[u] - z_m) <= d_m;
        found += int(is_near) & int(supports(fate[u]));
      }
    }
    return found >= wanted;
  };
  // Most find them next to themselves.
  return (reach_px > 1 && count(1)) || count(reach_px);
}

}  // namespace

int support_of_phantom_rule(const Camera& camera, double phantom_radius_m, float depth_m) {
  const double across_px2 = camera.fx_px * camera.fy_px * phantom_radius_m * phantom_radius_m /
                            (double{depth_m} * depth_m);
  return static_cast<int>(
      std::clamp(kLeastShare * std::numbers::pi / 4 * across_px2, 1.0, 1.0 * kMostSupport));
}

void drop_phantoms(const Camera& camera, DepthView sensor_depth_m, double phantom_radius_m,
                   PhantomWorkspace& workspace, ObstacleImage& out) {
  if (!(phantom_radius_m > 0)) return;
  const auto d_m = static_cast<float>(phantom_radius_m);
  const double f_px = std::min(camera.fx_px, camera.fy_px);
  const int height = out.depth_m.height();
  std::vector<Pixel>& lonely = workspace.lonely;
  lonely.clear();
  for (int v = 0; v < height; ++v) {
    append_doubtful(v > 0 ? out.depth_m.row(v - 1) : nullptr, out.depth_m.row(v),
                    v + 1 < height ? out.depth_m.row(v + 1) : nullptr, out.depth_m.width(), v, d_m,
                    workspace.is_near, lonely);
  }
  std::erase_if(lonely, [&](const Pixel& p) {
    const PixelFate fate = out.fate(p.u, p.v);
    if (fate != PixelFate::obstacle && fate != PixelFate::averaged) return true;
    const float z_m = out.depth_m(p.u, p.v);
    const int wanted = support_of_phantom_rule(camera, phantom_radius_m, z_m);
    const int reach_px =
        static_cast<int>(std::min(f_px * phantom_radius_m / z_m, 1.0 * kMostSupportReach_px));
    return has_support(sensor_depth_m, out, p, reach_px, d_m, wanted);
  });
  for (const Pixel& p : lonely) {
    --out.count[static_cast<std::size_t>(out.fate(p.u, p.v))];
    ++out.count[static_cast<std::size_t>(PixelFate::speckle)];
    out.fate(p.u, p.v) = PixelFate::speckle;
    out.depth_m(p.u, p.v) = kNoDepth;
  }
}

}  // namespace berth
