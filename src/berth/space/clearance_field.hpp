#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/space/box_distances.hpp"
#include "berth/space/unknown_space.hpp"

namespace berth {

/// How far each place of a ball is from what is occupied or unknown, between two bounds that hold
/// for any place in it: made once for a set of images, then constant, for any number of threads.
///
/// From below: space is cut into boxes of 6.4 mm, those that may hold something of it are marked,
/// and each node of a grid has its distance to the nearest of them. Between nodes |x|^2 - d(x)^2 is
/// convex, so d^2 is at least what lies on the line between their d^2, less h^2 sum t (1 - t).
/// From above: points that certainly belong to it, one for each box of 25.6 mm that has one.
class ClearanceField {
 public:
  static constexpr int kBox = 3, kCell = 4;  ///< Cube::level of the boxes, and from node to node
  static constexpr double kBox_m = 0.0064, kCell_m = 0.0256;
  /// What is farther away counts as so far.
  static constexpr double kRange_m = BoxDistances::kRangeBoxes * kBox_m;

  /// Of all places no farther than reach_m from the middle; beside them nothing is known. What
  /// `undecided` has read counts, too. Reuses its memory. Nobody may ask meanwhile.
  void build(const UnknownSpace& space, const UnknownSpace& undecided,
             const Eigen::Vector3d& middle_B_m, double reach_m);

  /// The same for surfaces that stand in B, and for all that they enclose.
  void build(std::span<const TriangleMesh> surfaces_B, const Eigen::Vector3d& middle_B_m,
             double reach_m);

  /// What vector code reads: all of the grid.
  struct Grid {
    Eigen::Vector3f low_B_m;
    std::array<int, 3> count = {};
    /// Of each node the square of a lower bound, in boxes; x first, then y. Two numbers more
    /// follow.
    const std::uint16_t* squared = nullptr;
    /// Of each cell a point's place in it, in 0.1 mm, ten bits for each coordinate, x lowest;
    /// kNoPoint where none is known.
    const std::uint32_t* point = nullptr;
  };
  static constexpr std::uint32_t kNoPoint = ~std::uint32_t{0};
  Grid grid() const;

 private:
  using Cell = std::array<int, 3>;

  std::size_t place(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * count_[1] + y) * count_[0] + x;
  }
  mesh::Cube cube_of(int x, int y, int z) const {
    return {kCell, first_[0] + x, first_[1] + y, first_[2] + z};
  }
  void begin(const Eigen::Vector3d& middle_B_m, double reach_m);
  void measure();
  void add_triangle(const std::array<Eigen::Vector3d, 3>& corners_B_m);
  /// Marks all boxes that no way leads to from outside.
  void fill();
  /// Which of a cell's boxes a way leads to that has come so far, from those of `from`.
  bool spread(std::size_t cell, std::uint64_t from, std::vector<std::uint64_t>& outside) const;
  Cell cell_of(const Eigen::Vector3d& p_B_m) const;
  bool has(const Cell& cell) const;
  /// What lies farther from the middle is out of the range of all nodes that are asked: these are
  /// up to three cells beyond the places.
  double outer_m() const { return reach_m_ + kRange_m + 4 * kCell_m; }
  /// Whether a cube is so far from the middle that no place is near.
  bool is_beyond(const Eigen::Vector3d& p_B_m, double half_m) const;
  void find_hidden(const UnknownSpace& space, const mesh::Cube& cube);
  void find_readings(const UnknownSpace& space);
  void add_readings(const FreeingCamera& view, std::uint8_t kind, const PixelRect& pixels);
  void mark_read(std::uint8_t kind, const Cell& low, const Cell& high);
  /// Whether there is a point of the cell that this one lies in: itself, rounded, if that holds.
  template <class Holds>
  bool take_point(const Eigen::Vector3d& p_B_m, const Holds& holds);
  /// Of a row of cells whether they and all around them may hold hidden space.
  void find_inside(int y, int z, std::vector<std::uint8_t>& inside) const;
  void find_boxes(const UnknownSpace& space, const UnknownSpace& undecided);
  std::uint64_t boxes_with_readings(const UnknownSpace& space, std::size_t at,
                                    const mesh::Cube& cube) const;
  void find_hidden_point(const UnknownSpace& space, const Cell& cell);

  /// The number of the first cell among all cubes.
  std::array<int, 3> first_ = {};
  std::array<int, 3> count_ = {};
  Eigen::Vector3d low_B_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d middle_B_m_ = Eigen::Vector3d::Zero();
  double reach_m_ = 0;
  /// Of each cell: whether it may hold hidden space, and readings of which views; and which of its
  /// boxes do.
  std::vector<std::uint8_t> may_;
  std::vector<std::uint64_t> boxes_;
  std::vector<std::uint32_t> point_;
  BoxDistances distances_;
  std::vector<std::uint16_t> squared_;
};

}  // namespace berth
