#include "sim/room.hpp"

namespace berth::sim {
namespace {

// Table top: x from -0.35 to 0.85 m, y from -0.45 to 0.45 m.
Box make_leg(const std::string& name, double x_m, double y_m) {
  constexpr double kHeight_m = -kFloorZ_m - 0.030;
  return {name, {0.05, 0.05, kHeight_m}, {x_m, y_m, kFloorZ_m + kHeight_m / 2}};
}

}  // namespace

const std::vector<Box>& table_boxes() {
  static const std::vector<Box> boxes{{"top", {1.20, 0.90, 0.030}, {0.25, 0, -0.015}},
                                      make_leg("leg_1", -0.30, -0.40),
                                      make_leg("leg_2", -0.30, 0.40),
                                      make_leg("leg_3", 0.80, -0.40),
                                      make_leg("leg_4", 0.80, 0.40)};
  return boxes;
}

const std::vector<Box>& obstacle_boxes() {
  static const std::vector<Box> boxes{{"low_box", {0.22, 0.14, 0.09}, {0.36, -0.31, 0.045}},
                                      {"tall_box", {0.12, 0.12, 0.26}, {0.16, 0.32, 0.13}},
                                      {"flat_box", {0.20, 0.16, 0.05}, {0.62, 0.30, 0.025}},
                                      {"cabinet", {0.80, 0.40, 1.60}, {-0.75, 1.45, 0.05}},
                                      {"floor", {7.0, 6.0, 0.10}, {0.5, 0.0, kFloorZ_m - 0.05}},
                                      {"wall", {7.0, 0.10, 4.0}, {0.5, 1.75, 1.0}}};
  return boxes;
}

TriangleMesh to_mesh(const Box& box) {
  TriangleMesh mesh;
  append(mesh, make_cuboid(box.size_m), Pose(Eigen::Translation3d(box.centre_T_m)));
  return mesh;
}

}  // namespace berth::sim
