#include "sim/cube_content.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth::sim {
namespace {

/// Where a cube is in an image: the pixels and depths of all of its points that are in the image.
struct Place {
  double near_m = std::numeric_limits<double>::infinity();
  double far_m = -std::numeric_limits<double>::infinity();
  PixelRect pixels{0, 0, 0, 0};
  /// The whole cube is in the image.
  bool is_inside = false;
};

/// Before this depth a cube is not projected. No point is lost: the whole image stands for it.
constexpr double kLeastDepth_m = 1e-6;
/// Doubles round; whoever is on the border of two pixels is in both.
constexpr double kRounding_px = 1e-7;

Place find_place(const Camera& camera, const Pose& X_CB, const CentredCube& cube) {
  Place place;
  double u_min = std::numeric_limits<double>::infinity();
  double u_max = -u_min, v_min = u_min, v_max = -u_min;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Eigen::Vector3d p_C = X_CB * (cube.centre_B + cube.half_m * sign);
    place.near_m = std::min(place.near_m, p_C.z());
    place.far_m = std::max(place.far_m, p_C.z());
    const double u = camera.fx_px * p_C.x() / p_C.z() + camera.cx_px;
    const double v = camera.fy_px * p_C.y() / p_C.z() + camera.cy_px;
    u_min = std::min(u_min, u), u_max = std::max(u_max, u);
    v_min = std::min(v_min, v), v_max = std::max(v_max, v);
  }
  if (place.far_m <= 0) return place;
  if (place.near_m < kLeastDepth_m) {
    place.pixels = {0, 0, camera.width_px, camera.height_px};
    return place;
  }
  // A projection keeps lines, so that the corners' rectangle holds the cube.
  const auto pixel = [](double x, int size) {
    return static_cast<int>(std::clamp(std::round(x), -1.0, size + 0.0));
  };
  const PixelRect all{pixel(u_min - kRounding_px, camera.width_px),
                      pixel(v_min - kRounding_px, camera.height_px),
                      pixel(u_max + kRounding_px, camera.width_px) + 1,
                      pixel(v_max + kRounding_px, camera.height_px) + 1};
  place.pixels = clip(all, camera.width_px, camera.height_px);
  place.is_inside = place.pixels == all;
  return place;
}

}  // namespace

CubeContent::CubeContent(const PointSpace& space) : space_(space) {
  for (const PointView& view : space.views()) X_CB_.push_back(view.X_BC.inverse());
}

CubeContent::Seen CubeContent::look(std::size_t k, const CentredCube& cube) const {
  const PointView& view = space_.views()[k];
  const double surface_thickness_m = space_.settings().surface_thickness_m;
  const Place place = find_place(view.camera, X_CB_[k], cube);
  Seen seen;
  seen.is_inside = place.is_inside && space_.is_young(k);
  seen.is_outside = place.pixels.u_begin >= place.pixels.u_end ||
                    place.pixels.v_begin >= place.pixels.v_end || !space_.is_young(k);
  seen.all_read = seen.all_covered = seen.all_free = place.is_inside;
  for (int v = place.pixels.v_begin; v < place.pixels.v_end; ++v) {
    for (int u = place.pixels.u_begin; u < place.pixels.u_end; ++u) {
      const double front_m = view.obstacle_depth_m(u, v);  // NaN is in front of nothing
      const double free_m = space_.free_depth(k)(u, v);
      seen.may_read |= front_m <= place.far_m && front_m + surface_thickness_m >= place.near_m;
      const double hides_m = space_.hidden_from_m(k)(u, v);
      const double ends_m = space_.hidden_to_m(k, {u, v});
      seen.may_hide |= hides_m < place.far_m && place.near_m < ends_m;
      seen.may_free |= free_m > std::max(place.near_m, 0.0);
      seen.all_read &= front_m <= place.near_m && place.far_m <= front_m + surface_thickness_m;
      seen.all_covered &=
          (front_m <= place.near_m || hides_m < place.near_m) && place.far_m < ends_m;
      seen.all_free &= place.far_m < free_m;
    }
  }
  return seen;
}

Content CubeContent::operator()(const CentredCube& cube, Wanted wanted) const {
  std::vector<Seen> seen;
  for (std::size_t k = 0; k < X_CB_.size(); ++k) seen.push_back(look(k, cube));
  bool may = false;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    if (seen[k].all_read) return Content::all;
    may |= seen[k].may_read;
    if (wanted == Wanted::reading) continue;
    bool may_be_seen_free = false, is_seen_free = false;
    for (std::size_t j = 0; j < seen.size(); ++j) {
      if (j == k) continue;
      may_be_seen_free |= seen[j].may_free;
      is_seen_free |= seen[j].all_free;
    }
    if (seen[k].all_covered && !may_be_seen_free) return Content::all;
    may |= seen[k].may_hide && !is_seen_free;
  }
  if (wanted != Wanted::reading && space_.settings().unobserved == Unobserved::unknown &&
      !seen.empty() && std::ranges::none_of(seen, &Seen::is_inside)) {
    if (std::ranges::all_of(seen, &Seen::is_outside)) return Content::all;
    may = true;
  }
  return may ? Content::some : Content::none;
}

}  // namespace berth::sim
