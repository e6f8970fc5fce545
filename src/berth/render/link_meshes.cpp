#include "berth/render/link_meshes.hpp"

namespace berth {
namespace {

using Corners = std::array<Eigen::Vector3f, 3>;

bool has_area(const Corners& corners) {
  const Eigen::Vector3d a = corners[0].cast<double>();
  const Eigen::Vector3d b = corners[1].cast<double>();
  const Eigen::Vector3d c = corners[2].cast<double>();
  return (b - a).cross(c - a).squaredNorm() > 0;
}

void put(const Corners& corners, int lane, TriangleBlock& block) {
  for (int corner = 0; corner < 3; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      block.corner_L_m[corner][axis][lane] = corners[corner][axis];
    }
  }
}

std::vector<TriangleBlock> blocks_of(const TriangleMesh& mesh_L) {
  std::vector<TriangleBlock> blocks;
  int used = TriangleBlock::kTriangles;
  for (const auto& [a, b, c] : mesh_L.triangles) {
    const Corners corners{mesh_L.vertices_m[a], mesh_L.vertices_m[b], mesh_L.vertices_m[c]};
    if (!has_area(corners)) continue;
    if (used == TriangleBlock::kTriangles) {
      blocks.emplace_back();
      used = 0;
    }
    for (int lane = used; lane < TriangleBlock::kTriangles; ++lane) {
      put(corners, lane, blocks.back());
    }
    ++used;
  }
  return blocks;
}

}  // namespace

LinkMeshes::LinkMeshes(const RobotModel& model, DrawnLinks drawn) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (!is_drawn(link, drawn)) continue;
    std::vector<TriangleBlock> blocks = blocks_of(link.mesh_L);
    if (blocks.empty()) continue;
    links_.push_back({i, link.id, link.mesh_L.bounding_box_m(), std::move(blocks)});
  }
}

}  // namespace berth
