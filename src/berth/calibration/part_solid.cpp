#include "berth/calibration/part_solid.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth {
namespace {

/// Directions of the planes that make the hull, spread evenly over the sphere (Fibonacci).
constexpr int kPlanes = 250;

bool is_ever_free(const Cell& cell, std::size_t link, const std::vector<EvidenceView>& views) {
  const Eigen::Vector3d p_L_m = middle_of(cell);
  for (const EvidenceView& view : views) {
    if (sees_free(view, view.pose.X_BL[link] * p_L_m)) return true;
  }
  return false;
}

/// Keeps those for which keep(i) holds.
template <class Keep>
CellSet kept(const std::vector<Cell>& cells, const Keep& keep) {
  std::vector<std::uint8_t> is_kept_at(cells.size());
  tbb::parallel_for(std::size_t{0}, cells.size(),
                    [&](std::size_t i) { is_kept_at[i] = keep(cells[i]); });
  CellSet set;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (is_kept_at[i]) set.insert(cells[i]);
  }
  return set;
}

/// Cells of readings of what moves near the piece, also beside the robot.
CellSet grown(const CarriedCells& piece, const std::vector<EvidenceView>& views,
              const std::vector<MovingReading>& readings) {
  const std::size_t link = piece.group.link;
  // Coarse cells, so that few neighbours are enough.
  const int coarse = static_cast<int>(kGrown_m / kCell_m);
  const auto coarse_of = [&](const Cell& cell) {
    return Cell((cell.cast<double>().array() / coarse).floor().matrix().cast<int>());
  };
  CellSet near;
  for (const Cell& cell : piece.cells.cells()) {
    each_cell_around(coarse_of(cell), 1, [&](const Cell& beside) { near.insert(beside); });
  }
  CellSet candidates;
  for (const MovingReading& reading : readings) {
    if (reading.is_explained || reading.is_at_edge) continue;
    const Cell cell = cell_of(views[reading.view].pose.X_BL[link].inverse() * reading.p_B_m);
    if (near.contains(coarse_of(cell)) && !piece.cells.contains(cell)) candidates.insert(cell);
  }
  return kept(candidates.cells(),
              [&](const Cell& cell) { return !is_ever_free(cell, link, views); });
}

/// The half-spaces about cells.
class Hull {
 public:
  Hull() {
    const double turn = std::numbers::pi * (3 - std::sqrt(5.0));
    for (int i = 0; i < kPlanes; ++i) {
      const double z = 1 - (2 * i + 1.0) / kPlanes;
      const double r = std::sqrt(1 - z * z);
      normals_.row(i) << r * std::cos(turn * i), r * std::sin(turn * i), z;
    }
    farthest_.setConstant(-std::numeric_limits<double>::infinity());
  }
  void add(const Cell& cell) { farthest_ = farthest_.cwiseMax(normals_ * cell.cast<double>()); }
  bool contains(const Cell& cell) const {
    return ((normals_ * cell.cast<double>()).array() <= farthest_.array() + 1e-9).all();
  }

 private:
  Eigen::Matrix<double, kPlanes, 3> normals_;
  Eigen::Matrix<double, kPlanes, 1> farthest_;
};

/// Those that hang together with the piece, by their faces.
SolidCells joined_to(const CarriedCells& piece, const CellSet& cells, SolidCells solid) {
  std::vector<Cell> open;
  const auto take = [&](const Cell& cell) {
    if (!cells.contains(cell)) return;
    std::uint8_t& is_solid = solid.is_solid[solid.index_of(cell)];
    if (is_solid) return;
    is_solid = 1;
    open.push_back(cell);
  };
  for (const Cell& cell : piece.cells.cells()) take(cell);
  while (!open.empty()) {
    const Cell at = open.back();
    open.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      take(at + Cell::Unit(axis));
      take(at - Cell::Unit(axis));
    }
  }
  return solid;
}

/// With what lies within `reach_m` of it and is hidden in all views.
SolidCells with_hidden(const SolidCells& seen, double reach_m, std::size_t link,
                       const std::vector<EvidenceView>& views) {
  const int margin = static_cast<int>(std::ceil(reach_m / kCell_m));
  const std::vector<float> distance = distance_field(seen, margin);
  SolidCells whole{seen.first - Cell::Constant(margin), seen.size + Cell::Constant(2 * margin), {}};
  whole.is_solid.resize(distance.size());
  tbb::parallel_for(0, whole.size.z(), [&](int z) {
    for (int y = 0; y < whole.size.y(); ++y) {
      for (int x = 0; x < whole.size.x(); ++x) {
        const Cell cell = whole.first + Cell(x, y, z);
        const std::size_t i = whole.index_of(cell);
        whole.is_solid[i] = distance[i] <= 0 || (kCell_m * distance[i] <= reach_m &&
                                                 is_hidden(middle_of(cell), link, views));
      }
    }
  });
  return whole;
}

}  // namespace

bool is_hidden(const Eigen::Vector3d& p_L_m, std::size_t link,
               const std::vector<EvidenceView>& views) {
  return std::ranges::all_of(views, [&](const EvidenceView& view) {
    return may_hide(view, view.pose.X_BL[link] * p_L_m);
  });
}

SolidCells solid_of(const CarriedCells& piece, const std::vector<EvidenceView>& views,
                    const std::vector<MovingReading>& readings, double hidden_m) {
  const CellSet more = grown(piece, views, readings);
  Hull hull;
  Eigen::AlignedBox3i box;
  const auto add = [&](const Cell& cell) {
    hull.add(cell);
    box.extend(cell);
  };
  for (const Cell& cell : piece.cells.cells()) add(cell);
  for (const Cell& cell : more.cells()) add(cell);
  std::vector<Cell> inside;
  for (int z = box.min().z(); z <= box.max().z(); ++z) {
    for (int y = box.min().y(); y <= box.max().y(); ++y) {
      for (int x = box.min().x(); x <= box.max().x(); ++x) {
        const Cell cell(x, y, z);
        if (hull.contains(cell)) inside.push_back(cell);
      }
    }
  }
  const CellSet solid_cells = kept(inside, [&](const Cell& cell) {
    return piece.cells.contains(cell) || more.contains(cell) ||
           !is_ever_free(cell, piece.group.link, views);
  });
  SolidCells solid{box.min(), box.max() - box.min() + Cell::Ones(), {}};
  solid.is_solid.resize(static_cast<std::size_t>(solid.size.prod()));
  return with_hidden(joined_to(piece, solid_cells, std::move(solid)), hidden_m, piece.group.link,
                     views);
}

}  // namespace berth
