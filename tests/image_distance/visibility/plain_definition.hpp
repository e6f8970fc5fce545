// The slow twin of find_visibility: many random points, a ray for each, no robot image.
#pragma once

#include <cstdint>

#include "berth/robot/robot_model.hpp"
#include "berth/types/image.hpp"
#include "berth/visibility/line_of_sight.hpp"
#include "sim/embree_renderer.hpp"

namespace berth {

/// What was there when the image was taken, and the robot that is asked about.
struct PlainView {
  Camera camera;
  DepthView sensor_depth_m;
  const Image<PixelFate>& fate;
  double tolerance_m;
  const sim::EmbreeRenderer& at_exposure;
  const sim::EmbreeRenderer& asked;
};

Sight plain_sight_of_space(const PlainView& view, const Eigen::Vector3d& p_C_m);
Sight plain_sight_of_surface(const PlainView& view, const Eigen::Vector3d& p_C_m);

/// Over this number of random points, evenly by area.
SightShares plain_surface_shares(const PlainView& view, const TriangleMesh& mesh_L,
                                 const Pose& X_CL, int count, std::uint32_t seed);
/// Over this number of random points, evenly by volume.
SightShares plain_ball_shares(const PlainView& view, const Eigen::Vector3d& centre_C_m,
                              double radius_m, int count, std::uint32_t seed);

/// The greatest difference of two shares of the same kind.
double greatest_difference(const SightShares& a, const SightShares& b);

}  // namespace berth
