#pragma once

#include <Eigen/Core>
#include <array>
#include <atomic>
#include <cstddef>
#include <vector>

namespace berth::mesh {

/// What vector code reads of a grid, each point as an atomic: others may find it meanwhile.
struct FieldPoints {
  /// As FieldGrid::squared_m2().
  float* squared_m2;
  Eigen::Vector3f low_L_m;
  float edge_m;
  std::array<int, 3> count;
};

/// Points side by side on a grid in the link's frame L, and the squares of their distances from its
/// surface. None is known at first: the first request for one finds it, and it is kept for all. Any
/// number of threads may ask at a time: what is found is the same bit for bit, whoever asks, and
/// from where.
class FieldGrid {
 public:
  FieldGrid() = default;
  ~FieldGrid();
  FieldGrid(const FieldGrid&) = delete;
  FieldGrid& operator=(const FieldGrid&) = delete;

  /// Once, before anybody asks: all points of the box, `edge_m` apart.
  void place(float edge_m, const Eigen::Vector3f& low_L_m, const Eigen::Vector3f& high_L_m);

  float edge_m() const { return edge_m_; }
  /// No point of the grid is farther from the origin of L.
  float reach_m() const { return reach_m_; }
  /// Where the cell lies that holds a point; whether it is in the grid.
  bool cell_of(const Eigen::Vector3f& p_L_m, std::array<int, 3>& cell,
               Eigen::Vector3f& place) const;
  /// Corner i of a cell lies at (i & 1, i >> 1 & 1, i >> 2).
  std::size_t corner(const std::array<int, 3>& cell, int i) const {
    const auto x = static_cast<std::size_t>(cell[0] + (i & 1));
    const auto y = static_cast<std::size_t>(cell[1] + (i >> 1 & 1));
    const auto z = static_cast<std::size_t>(cell[2] + (i >> 2));
    return (z * count_[1] + y) * count_[0] + x;
  }
  Eigen::Vector3f corner_L_m(const std::array<int, 3>& cell, int i) const {
    return low_L_m_ + edge_m_ * Eigen::Vector3f(static_cast<float>(cell[0] + (i & 1)),
                                                static_cast<float>(cell[1] + (i >> 1 & 1)),
                                                static_cast<float>(cell[2] + (i >> 2)));
  }
  /// All of them, x first, then y.
  FieldPoints all() const {
    return {
        points(),
        low_L_m_,
        edge_m_,
        {static_cast<int>(count_[0]), static_cast<int>(count_[1]), static_cast<int>(count_[2])}};
  }
  /// 0 where it is not known yet.
  float squared_m2(std::size_t point) const {
    return std::atomic_ref(points()[point]).load(std::memory_order_relaxed);
  }
  void keep(std::size_t point, float squared_m2) const {
    std::atomic_ref(points()[point]).store(squared_m2, std::memory_order_relaxed);
  }

 private:
  /// Begins at the first call. Its pages take memory when somebody writes to them.
  float* points() const {
    float* const points_m2 = points_m2_.load(std::memory_order_acquire);
    return points_m2 ? points_m2 : begin();
  }
  float* begin() const;

  float edge_m_ = 0;
  float reach_m_ = 0;
  Eigen::Vector3f low_L_m_ = Eigen::Vector3f::Zero();
  std::array<std::size_t, 3> count_ = {};
  mutable std::atomic<float*> points_m2_ = nullptr;
};

/// Grids around a link, the finer the nearer: between its points a grid bounds the distance from
/// below, mostly by less than half a millimetre too little; by more where two parts of the surface
/// are equally far.
class LinkField {
 public:
  /// Nearer to the link than this, a grid says too little.
  static constexpr float kNearest_m = 0.04f;

  /// Of triangles by the coordinates of their corners, as in LinkPatches.
  explicit LinkField(const std::array<std::vector<float>, 9>& corners_m);

  /// That for points about so far from the link; null nearer than kNearest_m.
  const FieldGrid* grid_for(float distance_m) const;

 private:
  std::array<FieldGrid, 3> grids_;
};

}  // namespace berth::mesh
