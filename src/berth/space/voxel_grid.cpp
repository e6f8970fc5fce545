#include "berth/space/voxel_grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "berth/space/unknown_space.hpp"

namespace berth {
namespace {

/// More than what rounding does to a pixel's coordinate, and to a depth.
constexpr double kPixelError = 1e-6;
constexpr double kDepthError_m = 1e-9;
/// Farther beside the image than any pixel.
constexpr double kFar_px = 1e6;
/// Nearer than what a voxel's number can count.
constexpr double kFarthest_m = 1e6;
/// What reaches nearer to the camera's plane may project anywhere.
constexpr double kLeastDepth_m = 1e-4;

/// Where a voxel projects to.
struct Footprint {
  double near_m = 0;
  double far_m = 0;
  /// Reaches beyond the image's border where the voxel does.
  PixelRect rect;
  bool is_before_camera = false;
};

/// A view of voxels of one size.
class VoxelView {
 public:
  VoxelView(const FreeingCamera& view, double edge_m)
      : view_(view),
        camera_(view.space->camera),
        reach_m_(0.5 * edge_m * view.X_CB.linear().cwiseAbs().rowwise().sum()) {}

  /// None where the voxel lies behind the camera or beside its image.
  std::optional<Footprint> footprint(const Eigen::Vector3d& centre_B) const {
    const Eigen::Vector3d p_C = view_.X_CB * centre_B;
    Footprint out;
    out.far_m = p_C.z() + reach_m_.z() + kDepthError_m;
    const double near_m = out.near_m = p_C.z() - reach_m_.z() - kDepthError_m;
    if (out.far_m <= 0) return std::nullopt;
    out.rect = {0, 0, camera_.width_px, camera_.height_px};
    if (near_m < kLeastDepth_m) return out;
    out.is_before_camera = true;
    const auto u = pixels(p_C.x(), reach_m_.x(), near_m, out.far_m, camera_.fx_px, camera_.cx_px);
    const auto v = pixels(p_C.y(), reach_m_.y(), near_m, out.far_m, camera_.fy_px, camera_.cy_px);
    out.rect = {u.first, v.first, u.second + 1, v.second + 1};
    if (in_image(out.rect).empty()) return std::nullopt;
    return out;
  }

  bool sees_all_free(const Footprint& at) const {
    if (view_.free_depth == nullptr || !at.is_before_camera) return false;
    return in_image(at.rect) == at.rect && at.far_m < least_of_m(*view_.free_depth, at.rect);
  }

  bool may_hide(const Footprint& at) const {
    const CameraSpace& space = *view_.space;
    // It was made for readings alone.
    if (!space.has_free_depth) return false;
    const PixelRect rect = in_image(at.rect);
    if (!(at.far_m > least_of_m(space.hidden_depth, rect))) return false;
    return !at.is_before_camera || !space.has_environment ||
           at.near_m < greatest_of_m(space.environment_front, rect);
  }

 private:
  PixelRect in_image(const PixelRect& rect) const {
    return clip(rect, camera_.width_px, camera_.height_px);
  }
  static std::pair<int, int> pixels(double centre, double reach, double near_m, double far_m,
                                    double focal_px, double centre_px) {
    const double low = centre - reach;
    const double high = centre + reach;
    const double least = std::min(low / near_m, low / far_m) * focal_px + centre_px;
    const double greatest = std::max(high / near_m, high / far_m) * focal_px + centre_px;
    const auto pixel = [](double at) {
      return static_cast<int>(std::floor(std::clamp(at, -kFar_px, kFar_px) + 0.5));
    };
    return {pixel(least - kPixelError), pixel(greatest + kPixelError)};
  }

  const FreeingCamera& view_;
  const Camera& camera_;
  /// How far a voxel reaches from its centre along the camera's axes.
  Eigen::Vector3d reach_m_;
};

Voxel sight_of(std::span<const VoxelView> views, const Eigen::Vector3d& centre_B) {
  bool is_hidden = false;
  for (const VoxelView& view : views) {
    const std::optional<Footprint> at = view.footprint(centre_B);
    if (!at) continue;
    if (view.sees_all_free(*at)) return Voxel::free;
    is_hidden = is_hidden || view.may_hide(*at);
  }
  return is_hidden ? Voxel::hidden : Voxel::unseen;
}

/// The voxels that a view's readings lie in.
void mark_readings(const FreeingCamera& view, VoxelGrid& grid) {
  const Camera& camera = view.space->camera;
  const DepthView depth_m = view.space->obstacle_depth_m;
  const Eigen::Matrix3d R = view.X_BC.linear() / grid.edge_m;
  const Eigen::Vector3d t = view.X_BC.translation() / grid.edge_m - grid.first.cast<double>();
  for (int v = 0; v < depth_m.height; ++v) {
    const double y = (v - camera.cy_px) / camera.fy_px;
    for (int u = 0; u < depth_m.width; ++u) {
      const double z_m = depth_m(u, v);
      if (!std::isfinite(z_m)) continue;
      const Eigen::Vector3d p_C(z_m * (u - camera.cx_px) / camera.fx_px, z_m * y, z_m);
      const Eigen::Array3d at = (R * p_C + t).array().floor();
      if ((at < 0).any() || (at >= grid.count.cast<double>().array()).any()) continue;
      grid.voxels[grid.index(at.cast<int>())] = Voxel::occupied;
    }
  }
}

}  // namespace

void lay_voxels(const Eigen::AlignedBox3d& box_B_m, double edge_m, VoxelGrid& grid) {
  const auto text = [](double value) { return std::to_string(value); };
  if (!(edge_m >= VoxelGrid::kLeastEdge_m) || !std::isfinite(edge_m)) {
    throw std::invalid_argument("the edge of a voxel is " + text(edge_m) +
                                " m; expected at least " + text(VoxelGrid::kLeastEdge_m));
  }
  // So is NaN.
  if (!(box_B_m.sizes().array() > 0).all() || !box_B_m.sizes().allFinite()) {
    throw std::invalid_argument("the box of the voxels is empty or not finite; expected metres");
  }
  if (!(box_B_m.min().array().abs() <= kFarthest_m).all()) {
    throw std::invalid_argument("the box of the voxels is farther away than " + text(kFarthest_m) +
                                " m; expected one around the robot");
  }
  const Eigen::Array3d first = (box_B_m.min().array() / edge_m).floor();
  const Eigen::Array3d count = (box_B_m.max().array() / edge_m).ceil() - first;
  if (!(count.prod() <= VoxelGrid::kMostVoxels)) {
    throw std::invalid_argument("the box has " + text(count.prod()) + " voxels; expected at most " +
                                text(VoxelGrid::kMostVoxels));
  }
  grid.edge_m = edge_m;
  grid.first = first.cast<int>();
  grid.count = count.cast<int>();
  grid.voxels.assign(static_cast<std::size_t>(count.prod()), Voxel::unseen);
}

void find_voxels(std::span<const FreeingCamera> views, VoxelGrid& grid) {
  std::vector<VoxelView> seeing;
  for (const FreeingCamera& view : views) {
    if (!view.space->is_empty()) seeing.emplace_back(view, grid.edge_m);
  }
  std::size_t i = 0;
  for (int z = 0; z < grid.count.z(); ++z) {
    for (int y = 0; y < grid.count.y(); ++y) {
      for (int x = 0; x < grid.count.x(); ++x, ++i) {
        grid.voxels[i] = sight_of(seeing, grid.centre_m({x, y, z}));
      }
    }
  }
  for (const FreeingCamera& view : views) {
    if (!view.space->is_empty()) mark_readings(view, grid);
  }
}

}  // namespace berth
