// The vector code's bounds, callable by themselves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "berth/distance/robot_patches.hpp"

namespace berth::testing {

struct PointBounds {
  float lower_m = 0;
  float upper_m = 0;
  int triangle = -1;
};

/// Of up to 8 points in the link's frame, at most slack_m and some roundings apart; `hint` is a
/// leaf to begin with.
void bound_points(const LinkPatches& link, float error_m, int hint, float slack_m, int count,
                  const Eigen::Vector3f* p_L_m, PointBounds* out);

/// Of a point about `distance_m` from the link by its field: less than the square of its distance.
float bound_by_field_m2(const LinkPatches& link, int hint, float distance_m,
                        const Eigen::Vector3f& p_L_m);

/// Of a cube's children from the squared distances of its corners.
void bound_cube_children(const std::array<float, 8>& squared_m2, float edge_m,
                         std::array<float, 64>& out_m);

/// Of the cube itself, and of its centre.
float bound_cube(const std::array<float, 8>& squared_m2, float edge_m);
float bound_cube_centre(const std::array<float, 8>& squared_m2, float edge_m);

/// Squares of bounds at the corners of the part of a cube that begins at `t`, in edges.
std::array<float, 8> bound_corners_within(const std::array<float, 8>& squared_m2, float edge_m,
                                          const std::array<float, 3>& t, float part);

}  // namespace berth::testing
