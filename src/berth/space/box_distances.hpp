// Inside space/ only: from the nodes of a grid to the nearest of many boxes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace berth {

/// A grid of cells, x first, then y. Each consists of 4 x 4 x 4 boxes, one bit each, in the same
/// order; its node is its lowest corner. Lengths are in cells, from the lowest corner of all.
struct BoxGrid {
  /// Along x a multiple of kRow.
  std::array<int, 3> count = {};
  static constexpr int kRow = 8;
  const std::uint64_t* boxes = nullptr;
  /// Nodes in this ball are asked about.
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double radius = 0;

  /// Of the cells along x, from `begin` to before `end`, those that are in the ball that reaches
  /// `more` farther; y and z from the lowest corner, too.
  struct Row {
    int begin = 0, end = 0;
  };
  Row in_ball(double more, double y, double z) const;
};

/// Distances are found along x, then along y, then along z.
class BoxDistances {
 public:
  /// What is farther away counts as so far, in boxes.
  static constexpr int kRangeBoxes = 31;

  /// Of each node the square of its distance to the nearest box, in boxes; 0 where nobody asks. Two
  /// numbers more follow. Boxes more than kRangeBoxes and two cells away from the ball are not
  /// needed.
  void find(const BoxGrid& grid, std::vector<std::uint16_t>& squared);

 private:
  /// Of each layer of boxes, at each node's x and y: the four of a cell side by side.
  std::vector<std::int16_t> along_xy_;
};

}  // namespace berth
