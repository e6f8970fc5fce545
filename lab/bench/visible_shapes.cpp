#include "lab/bench/visible_shapes.hpp"

namespace berth::lab {
namespace {

constexpr int kStep = 2;

class Grid {
 public:
  Grid(const Camera& camera, const RobotImage& robot)
      : camera_(camera),
        robot_(robot),
        vertex_(robot.link_id.width(), robot.link_id.height(), -1) {}

  /// Two triangles between the pixel and its neighbours to the right and below.
  void add_square(int u, int v, LinkId id, TriangleMesh& mesh_C) {
    const int right = u + kStep;
    const int below = v + kStep;
    if (robot_.link_id(right, v) != id || robot_.link_id(u, below) != id ||
        robot_.link_id(right, below) != id) {
      return;
    }
    const std::uint32_t a = vertex(u, v, mesh_C);
    const std::uint32_t b = vertex(right, v, mesh_C);
    const std::uint32_t c = vertex(u, below, mesh_C);
    const std::uint32_t d = vertex(right, below, mesh_C);
    mesh_C.triangles.push_back({a, b, c});
    mesh_C.triangles.push_back({b, d, c});
  }

 private:
  /// A pixel belongs to one link, so it is a vertex of one mesh.
  std::uint32_t vertex(int u, int v, TriangleMesh& mesh_C) {
    std::int32_t& index = vertex_(u, v);
    if (index < 0) {
      index = static_cast<std::int32_t>(mesh_C.vertices_m.size());
      const double z_m = robot_.depth_m(u, v);
      const Eigen::Vector3d p((u - camera_.cx_px) / camera_.fx_px * z_m,
                              (v - camera_.cy_px) / camera_.fy_px * z_m, z_m);
      mesh_C.vertices_m.push_back(p.cast<float>());
    }
    return static_cast<std::uint32_t>(index);
  }

  const Camera& camera_;
  const RobotImage& robot_;
  Image<std::int32_t> vertex_;
};

}  // namespace

std::shared_ptr<const LinkShapes> visible_shapes_C(const Camera& camera, const RobotImage& robot,
                                                   int link_count) {
  auto shapes = std::make_shared<LinkShapes>(link_count);
  Grid grid(camera, robot);
  for (int v = 0; v + kStep < camera.height_px; v += kStep) {
    for (int u = 0; u + kStep < camera.width_px; u += kStep) {
      const LinkId id = robot.link_id(u, v);
      if (id != kNoLink && id != kEnvironmentLink) grid.add_square(u, v, id, (*shapes)[id - 1]);
    }
  }
  return shapes;
}

}  // namespace berth::lab
