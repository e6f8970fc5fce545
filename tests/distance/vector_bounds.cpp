#include "tests/distance/vector_bounds.hpp"

#include <algorithm>
#include <cmath>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/distance/vector_bounds.cpp"
#include "hwy/foreach_target.h"

#include "berth/distance/cube_corners-inl.hpp"
#include "berth/distance/field_bound-inl.hpp"
#include "berth/distance/nearest_point-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace berth::testing {
namespace HWY_NAMESPACE {

using namespace mesh;
using namespace mesh::HWY_NAMESPACE;

CubeCorners corners_from(const std::array<float, 8>& squared_m2) {
  CubeCorners corners;
  std::copy(squared_m2.begin(), squared_m2.end(), corners.squared_m2);
  return corners;
}

void points(const LinkPatches& link, float error_m, int hint, float slack_m, int count,
            const Eigen::Vector3f* p_L_m, PointBounds* out) {
  NearPoints near;
  near.count = count;
  std::copy_n(p_L_m, count, near.p_L_m);
  NearestPointSearch(link, error_m).find(hint, slack_m, near);
  for (int i = 0; i < count; ++i) {
    out[i] = {near.distance[i].lower_m, near.distance[i].upper_m, near.distance[i].triangle};
  }
}

float by_field(const LinkPatches& link, int hint, float distance_m, const Eigen::Vector3f& p_L_m) {
  const FieldGrid* const grid = link.field->grid_for(distance_m);
  return grid ? field_bound_m2(*grid, link, p_L_m, hint) : 0;
}

void children(const std::array<float, 8>& squared_m2, float edge_m, std::array<float, 64>& out_m) {
  alignas(64) float bounds_m[64];
  bound_child_cubes(corners_from(squared_m2), edge_m, ~std::uint64_t{0}, bounds_m);
  std::copy_n(bounds_m, 64, out_m.begin());
}

float whole(const std::array<float, 8>& squared_m2, float edge_m) {
  return least_distance_m(corners_from(squared_m2), edge_m);
}

float centre(const std::array<float, 8>& squared_m2, float edge_m) {
  return centre_distance_m(corners_from(squared_m2), edge_m);
}

void within(const std::array<float, 8>& squared_m2, float edge_m, const std::array<float, 3>& t,
            float part, std::array<float, 8>& out) {
  const CubeCorners corners = corners_within(corners_from(squared_m2), edge_m, t, part);
  std::copy_n(corners.squared_m2, 8, out.begin());
}

}  // namespace HWY_NAMESPACE
}  // namespace berth::testing
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace berth::testing {

HWY_EXPORT(points);
HWY_EXPORT(by_field);
HWY_EXPORT(children);
HWY_EXPORT(whole);
HWY_EXPORT(centre);
HWY_EXPORT(within);

void bound_points(const LinkPatches& link, float error_m, int hint, float slack_m, int count,
                  const Eigen::Vector3f* p_L_m, PointBounds* out) {
  HWY_DYNAMIC_DISPATCH(points)(link, error_m, hint, slack_m, count, p_L_m, out);
}

float bound_by_field_m2(const LinkPatches& link, int hint, float distance_m,
                        const Eigen::Vector3f& p_L_m) {
  return HWY_DYNAMIC_DISPATCH(by_field)(link, hint, distance_m, p_L_m);
}

void bound_cube_children(const std::array<float, 8>& squared_m2, float edge_m,
                         std::array<float, 64>& out_m) {
  HWY_DYNAMIC_DISPATCH(children)(squared_m2, edge_m, out_m);
}

float bound_cube(const std::array<float, 8>& squared_m2, float edge_m) {
  return HWY_DYNAMIC_DISPATCH(whole)(squared_m2, edge_m);
}

float bound_cube_centre(const std::array<float, 8>& squared_m2, float edge_m) {
  return HWY_DYNAMIC_DISPATCH(centre)(squared_m2, edge_m);
}

std::array<float, 8> bound_corners_within(const std::array<float, 8>& squared_m2, float edge_m,
                                          const std::array<float, 3>& t, float part) {
  std::array<float, 8> out;
  HWY_DYNAMIC_DISPATCH(within)(squared_m2, edge_m, t, part, out);
  return out;
}

}  // namespace berth::testing
#endif  // HWY_ONCE
