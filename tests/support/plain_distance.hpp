// The definition of the whole robot's distances, straight from its words, for small worlds.
#pragma once

#include <array>
#include <vector>

#include "tests/support/mesh_world.hpp"

namespace berth::testing {

/// E of one pixel after another (D1, D2, D6).
Image<double> plain_free_depth(const MeshWorldView& view, const SpaceSettings& settings);

/// What a point is, asked of all views.
class PlainSpace {
 public:
  explicit PlainSpace(const MeshWorld& world);
  /// In the surface layer of view k's pixel, give or take `slack_m` along the camera's axis.
  bool is_reading(std::size_t k, const Eigen::Vector3d& p_B, double slack_m = 0) const;
  bool is_hidden(const Eigen::Vector3d& p_B) const;
  /// View k sees it free.
  bool is_free(std::size_t k, const Eigen::Vector3d& p_B) const;
  const MeshWorld& world() const { return world_; }

 private:
  bool is_behind(std::size_t k, const Eigen::Vector3d& p_B) const;

  const MeshWorld& world_;
  std::vector<Image<double>> free_m_;
  std::vector<DepthImage> hidden_from_m_;
};

/// The least distance from a link's triangles to all surface layers, or to all that lies behind a
/// reading: every triangle against every pixel; the range where none is nearer.
double plain_pixel_distance(const MeshWorld& world, std::size_t link, bool to_shadow,
                            double range_m);

/// A link's triangles in frame B.
class LinkSurface {
 public:
  LinkSurface(const MeshWorld& world, std::size_t link);
  double distance_m(const Eigen::Vector3d& p_B) const;

 private:
  std::vector<std::array<Eigen::Vector3d, 3>> triangles_B_;
};

}  // namespace berth::testing
