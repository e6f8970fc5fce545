#include "berth/space/undecided.hpp"

#include <algorithm>
#include <cstring>

namespace berth {
namespace {

/// Whether all readings around the point's pixel lie behind it.
bool sees_through(const FreeingCamera& view, const Eigen::Vector3d& p_B_m) {
  const CameraSpace& space = *view.space;
  const Eigen::Vector3d p_C_m = view.X_CB * p_B_m;
  const auto pixel = pixel_of(space.camera, p_C_m);
  if (!view.free_depth || !pixel) return false;
  const PixelRect around = clip({pixel->u - 1, pixel->v - 1, pixel->u + 2, pixel->v + 2},
                                space.camera.width_px, space.camera.height_px);
  DepthUnits least = kEndlessUnits;
  for (int v = around.v_begin; v < around.v_end; ++v) {
    const DepthUnits* const row = space.sensor_depth.row(v);
    least = std::min(least, *std::min_element(row + around.u_begin, row + around.u_end));
  }
  // Without a reading nothing was seen.
  if (least == kEndlessUnits) return false;
  const double moved_m = space.settings.obstacle_speed_m_s * view.age_s;
  return p_C_m.z() < in_metres(least) - space.settings.free_space_margin_m - moved_m;
}

}  // namespace

bool find_undecided(std::span<const FreeingCamera> views, std::size_t k,
                    const Image<PixelFate>& fate, DepthImage& out_m) {
  const FreeingCamera& view = views[k];
  const Camera& camera = view.space->camera;
  out_m.resize(camera.width_px, camera.height_px, kNoDepth);
  bool has_any = false;
  for (int v = 0; v < camera.height_px; ++v) {
    const PixelFate* const row = fate.row(v);
    // Most rows have none.
    constexpr auto kPatch = static_cast<int>(PixelFate::flying_patch);
    if (std::memchr(row, kPatch, static_cast<std::size_t>(camera.width_px)) == nullptr) continue;
    for (int u = 0; u < camera.width_px; ++u) {
      if (row[u] != PixelFate::flying_patch) continue;
      const double z_m = in_metres(view.space->sensor_depth(u, v));
      const Eigen::Vector3d p_B_m =
          view.X_BC * Eigen::Vector3d(z_m * (u - camera.cx_px) / camera.fx_px,
                                      z_m * (v - camera.cy_px) / camera.fy_px, z_m);
      bool is_freed = false, is_seen = false;
      for (std::size_t j = 0; j < views.size() && !is_seen; ++j) {
        if (j == k) continue;
        is_seen = sees_through(views[j], p_B_m);
        is_freed = is_freed || is_seen_free(views[j], p_B_m);
      }
      if (is_seen || !is_freed) continue;
      out_m(u, v) = static_cast<float>(z_m);
      has_any = true;
    }
  }
  return has_any;
}

}  // namespace berth
