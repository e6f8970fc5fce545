#include "apps/view/space_grid.hpp"
#include "berth/pipeline/frame_set.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace berth::app {
namespace {

/// Whether a camera measured a surface at this point.
bool is_on_surface(const FreeingCamera& view, const Eigen::Vector3d& p_B) {
  const Eigen::Vector3d p_C = view.X_CB * p_B;
  const auto pixel = pixel_of(view.space->camera, p_C);
  if (!pixel) return false;
  const double depth_m = view.space->obstacle_depth_m(pixel->u, pixel->v);
  const SpaceSettings& settings = view.space->settings;
  return p_C.z() >= depth_m - settings.free_space_margin_m &&
         p_C.z() <= depth_m + settings.surface_thickness_m;
}

CellSight sight_at(const UnknownSpace& space, const Eigen::Vector3d& p_B) {
  if (space.hiding_pixel(p_B)) return CellSight::hidden;
  for (const FreeingCamera& view : space.views()) {
    if (is_seen_free(view, p_B) || is_on_surface(view, p_B)) return CellSight::seen;
  }
  return CellSight::unseen;
}

}  // namespace

Eigen::AlignedBox3d box_around(const RobotModel& model, const RobotPose& pose, double margin_m) {
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    if (link.role != LinkRole::evaluated || link.mesh_L.empty()) continue;
    const Eigen::AlignedBox3d box_L(link.mesh_L.bounding_box_m().cast<double>());
    box.extend(box_L.transformed(pose.X_BL[i]));
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(margin_m);
  return box.isEmpty() ? box : Eigen::AlignedBox3d(box.min() - margin, box.max() + margin);
}

SpaceGrid find_space_grid(const FrameSet& frames, const Eigen::AlignedBox3d& box) {
  SpaceGrid grid;
  if (box.isEmpty()) return grid;
  grid.corner_m = box.min();
  grid.edge_m = std::max(kLeastEdge_m, std::cbrt(box.volume() / kMostCells));
  for (int axis = 0; axis < 3; ++axis) {
    grid.cells[axis] = std::max(1, static_cast<int>(box.sizes()[axis] / grid.edge_m));
  }
  const auto [columns, rows, layers] = grid.cells;
  grid.sight.resize(static_cast<std::size_t>(columns) * rows * layers);
  tbb::parallel_for(0, layers, [&, columns = columns, rows = rows](int layer) {
    CellSight* cell = grid.sight.data() + static_cast<std::size_t>(layer) * rows * columns;
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column, ++cell) {
        const Eigen::Vector3d middle(column + 0.5, row + 0.5, layer + 0.5);
        *cell = sight_at(frames.space(), grid.corner_m + grid.edge_m * middle);
      }
    }
  });
  return grid;
}

PageMessage space_message(const SpaceGrid& grid) {
  return binary_message({{"type", "space"},
                         {"corner_m", {grid.corner_m.x(), grid.corner_m.y(), grid.corner_m.z()}},
                         {"edge_m", grid.edge_m},
                         {"cells", grid.cells}},
                        {std::as_bytes(std::span(grid.sight))});
}

}  // namespace berth::app
