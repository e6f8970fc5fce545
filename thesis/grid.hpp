#pragma once

namespace berth {

/// Column and row of the cells of a square grid, counted by rows.
template <int side>
struct Grid {
  alignas(64) float column[side * side];
  alignas(64) float row[side * side];
};

template <int side>
constexpr Grid<side> make_grid() {
  Grid<side> grid{};
  for (int i = 0; i < side * side; ++i) {
    grid.column[i] = static_cast<float>(i % side);
    grid.row[i] = static_cast<float>(i / side);
  }
  return grid;
}

/// The children of a node of an obstacle tree.
inline constexpr Grid<4> kNodeGrid = make_grid<4>();
/// The pixels of a tile.
inline constexpr Grid<8> kTileGrid = make_grid<8>();

}  // namespace berth
