#include "tests/image_distance/visibility/plain_definition.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace berth {
namespace {

/// By the order of Sight.
using Counts = std::array<double, kSightCount>;

SightShares shares_of(const Counts& counts, int sum) {
  const auto share = [&](Sight sight) {
    return static_cast<float>(counts[static_cast<std::size_t>(sight)] / sum);
  };
  return {share(Sight::seen), share(Sight::hidden_by_obstacles), share(Sight::hidden_by_robot),
          share(Sight::no_reading), share(Sight::outside_image)};
}

struct Projection {
  double u;
  double v;
  bool is_inside;
  Pixel nearest() const {
    return {static_cast<int>(std::lround(u)), static_cast<int>(std::lround(v))};
  }
};

Projection plain_projection(const Camera& camera, const Eigen::Vector3d& p_C_m) {
  if (p_C_m.z() <= 0) return {0, 0, false};
  const double u = camera.cx_px + camera.fx_px * p_C_m.x() / p_C_m.z();
  const double v = camera.cy_px + camera.fy_px * p_C_m.y() / p_C_m.z();
  return {u, v, u > -0.5 && v > -0.5 && u < camera.width_px - 0.5 && v < camera.height_px - 0.5};
}

bool was_dropped(PixelFate fate) {
  return fate != PixelFate::obstacle && fate != PixelFate::robot && fate != PixelFate::environment;
}

}  // namespace

Sight plain_sight_of_space(const PlainView& view, const Eigen::Vector3d& p_C_m) {
  const Projection at = plain_projection(view.camera, p_C_m);
  if (!at.is_inside) return Sight::outside_image;
  const Pixel pixel = at.nearest();
  const PixelFate fate = view.fate(pixel.u, pixel.v);
  if (was_dropped(fate)) return Sight::no_reading;
  if (fate == PixelFate::obstacle) {
    return view.sensor_depth_m(pixel.u, pixel.v) < p_C_m.z() ? Sight::hidden_by_obstacles
                                                             : Sight::seen;
  }
  const double robot_m = view.at_exposure.hit(pixel.u, pixel.v).depth_m;
  return p_C_m.z() < robot_m - view.tolerance_m ? Sight::seen : Sight::hidden_by_robot;
}

Sight plain_sight_of_surface(const PlainView& view, const Eigen::Vector3d& p_C_m) {
  constexpr double kSameSurface_m = 1e-4;
  const Projection at = plain_projection(view.camera, p_C_m);
  if (!at.is_inside) return Sight::outside_image;
  if (view.asked.hit(at.u, at.v).depth_m < p_C_m.z() - kSameSurface_m)
    return Sight::hidden_by_robot;
  const Pixel pixel = at.nearest();
  const PixelFate fate = view.fate(pixel.u, pixel.v);
  if (was_dropped(fate)) return Sight::no_reading;
  const double least_m = p_C_m.z() - view.tolerance_m;
  if (fate == PixelFate::obstacle) {
    return view.sensor_depth_m(pixel.u, pixel.v) < least_m ? Sight::hidden_by_obstacles
                                                           : Sight::seen;
  }
  return view.at_exposure.hit(at.u, at.v).depth_m < least_m ? Sight::hidden_by_robot : Sight::seen;
}

SightShares plain_surface_shares(const PlainView& view, const TriangleMesh& mesh_L,
                                 const Pose& X_CL, int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto corner = [&](std::size_t i, int k) -> Eigen::Vector3d {
    return X_CL * mesh_L.vertices_m[mesh_L.triangles[i][k]].cast<double>();
  };
  std::vector<double> areas;
  for (std::size_t i = 0; i < mesh_L.triangles.size(); ++i)
    areas.push_back((corner(i, 1) - corner(i, 0)).cross(corner(i, 2) - corner(i, 0)).norm());
  std::discrete_distribution<std::size_t> by_area(areas.begin(), areas.end());
  Counts counts{};
  for (int k = 0; k < count; ++k) {
    const std::size_t i = by_area(random);
    const double root = std::sqrt(unit(random));
    const double t = unit(random);
    const Eigen::Vector3d p_C_m =
        (1 - root) * corner(i, 0) + root * (1 - t) * corner(i, 1) + root * t * corner(i, 2);
    ++counts[static_cast<std::size_t>(plain_sight_of_surface(view, p_C_m))];
  }
  return shares_of(counts, count);
}

SightShares plain_ball_shares(const PlainView& view, const Eigen::Vector3d& centre_C_m,
                              double radius_m, int count, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-1, 1);
  Counts counts{};
  for (int k = 0; k < count;) {
    const Eigen::Vector3d p(side(random), side(random), side(random));
    if (p.squaredNorm() > 1) continue;
    ++counts[static_cast<std::size_t>(plain_sight_of_space(view, centre_C_m + radius_m * p))];
    ++k;
  }
  return shares_of(counts, count);
}

double greatest_difference(const SightShares& a, const SightShares& b) {
  return std::max(
      {std::abs(a.seen - b.seen), std::abs(a.hidden_by_obstacles - b.hidden_by_obstacles),
       std::abs(a.hidden_by_robot - b.hidden_by_robot), std::abs(a.no_reading - b.no_reading),
       std::abs(a.outside_image - b.outside_image)});
}

}  // namespace berth
