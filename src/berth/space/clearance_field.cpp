#include "berth/space/clearance_field.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "berth/space/blocks.hpp"

namespace berth {
namespace {

constexpr std::uint8_t kHidden = 1, kRead = 2;
constexpr double kStep_m = mesh::Cube::kLeastEdge_m;
constexpr int kStepsPerCell = 1 << 2 * ClearanceField::kCell;
constexpr std::uint64_t kAllBoxes = ~std::uint64_t{0};
/// The boxes of a cell at its ends along an axis.
constexpr std::uint64_t kFirstX = 0x1111'1111'1111'1111u, kLastX = kFirstX << 3;
constexpr std::uint64_t kFirstY = 0x000F'000F'000F'000Fu, kLastY = kFirstY << 12;
constexpr std::uint64_t kFirstZ = 0xFFFF;

/// A number of up to 31 for each of a cell's 16 columns, one byte each.
using Columns = std::array<std::uint64_t, 2>;
constexpr std::uint64_t kOnes = 0x0101'0101'0101'0101u;
/// Of eight bits a byte each: 0 where the bit is set, else 0xFF.
constexpr auto kUnset = [] {
  std::array<std::uint64_t, 256> bytes{};
  for (std::size_t i = 0; i < 256; ++i) {
    for (std::size_t k = 0; k < 8; ++k) {
      if ((i >> k & 1) == 0) bytes[i] |= std::uint64_t{0xFF} << 8 * k;
    }
  }
  return bytes;
}();

/// Each number one more, but no more than kRangeBoxes, which is 31.
std::uint64_t one_more(std::uint64_t columns) {
  const std::uint64_t sum = columns + kOnes;
  return sum - (sum >> 5 & kOnes);
}

/// Goes over the boxes of one cell, upwards or downwards: how far each column's last one is behind.
void pass(std::uint64_t boxes, bool upwards, Columns& behind) {
  for (int i = 0; i < 4; ++i) {
    const std::uint64_t layer = boxes >> 16 * (upwards ? i : 3 - i);
    for (std::size_t half = 0; half < 2; ++half) {
      behind[half] = one_more(behind[half]) & kUnset[layer >> 8 * half & 255];
    }
  }
}

/// The four columns of one of its rows.
std::uint32_t row_of(const Columns& columns, std::size_t row) {
  return static_cast<std::uint32_t>(columns[row / 2] >> 32 * (row % 2));
}

/// A place in a cell of either size, in steps.
std::uint32_t packed(const std::array<int, 3>& steps) {
  return static_cast<std::uint32_t>(steps[0] | steps[1] << 10 | steps[2] << 20);
}
std::array<int, 3> unpacked(std::uint32_t point) {
  return {static_cast<int>(point & 1023), static_cast<int>(point >> 10 & 1023),
          static_cast<int>(point >> 20 & 1023)};
}

/// Whether it is occupied by what this view has read (D4).
bool has_read(const FreeingCamera& view, const Eigen::Vector3d& p_B_m) {
  const Eigen::Vector3d p_C_m = view.X_CB * p_B_m;
  const auto pixel = pixel_of(view.space->camera, p_C_m);
  if (!pixel) return false;
  const double depth_m = view.space->obstacle_depth_m(pixel->u, pixel->v);
  return depth_m <= p_C_m.z() && p_C_m.z() <= depth_m + view.space->settings.surface_thickness_m;
}

/// Visits the boxes of a row beside a node whose next box is number `at`, with their distances from
/// it.
template <class Take>
void each_beside(int at, int count, const Take& take) {
  for (int d = 0; d < ClearanceField::kRangeBoxes; ++d) {
    if (at + d < count) take(at + d, d);
    if (at - 1 - d >= 0) take(at - 1 - d, d);
  }
}

}  // namespace

ClearanceField::Cell ClearanceField::cell_of(const Eigen::Vector3d& p_B_m) const {
  const Eigen::Vector3d at = (p_B_m - low_B_m_) / kCell_m;
  return {static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
          static_cast<int>(std::floor(at.z()))};
}

bool ClearanceField::has(const Cell& cell) const {
  return cell[0] >= 0 && cell[1] >= 0 && cell[2] >= 0 && cell[0] < count_[0] &&
         cell[1] < count_[1] && cell[2] < count_[2];
}

bool ClearanceField::is_beyond(const Eigen::Vector3d& p_B_m, double half_m) const {
  const Eigen::Array3d beside_m = ((p_B_m - middle_B_m_).array().abs() - half_m).max(0.0);
  return beside_m.matrix().norm() > outer_m();
}

void ClearanceField::begin(const Eigen::Vector3d& middle_B_m, double reach_m) {
  middle_B_m_ = middle_B_m;
  reach_m_ = reach_m;
  const double half_m = outer_m();
  for (int k = 0; k < 3; ++k) {
    const double low_m = middle_B_m[k] - half_m - mesh::Cube::kCorner_m;
    // Whole cells of twice the size, too.
    first_[k] = 2 * static_cast<int>(std::floor(low_m / (2 * kCell_m)));
    count_[k] = 2 * static_cast<int>(std::ceil(half_m / kCell_m)) + 2;
    half_count_[k] = count_[k] / 2;
    low_B_m_[k] = mesh::Cube::kCorner_m + first_[k] * kCell_m;
  }
  const auto cells = static_cast<std::size_t>(count_[0]) * count_[1] * count_[2];
  may_.assign(cells, 0);
  boxes_.assign(cells, 0);
  point_[0].assign(cells, kNoPoint);
  squared_.resize(cells + 2);
}

void ClearanceField::build(const UnknownSpace& space, const UnknownSpace& undecided,
                           const Eigen::Vector3d& middle_B_m, double reach_m) {
  begin(middle_B_m, reach_m);
  const mesh::Cube low = cube_of(0, 0, 0);
  const mesh::Cube high = cube_of(count_[0] - 1, count_[1] - 1, count_[2] - 1);
  constexpr int kUp = 2 * (mesh::Cube::kTopLevel - kCell);
  for (int z = low.z >> kUp; z <= high.z >> kUp; ++z) {
    for (int y = low.y >> kUp; y <= high.y >> kUp; ++y) {
      for (int x = low.x >> kUp; x <= high.x >> kUp; ++x) {
        find_hidden(space, {mesh::Cube::kTopLevel, x, y, z});
      }
    }
  }
  find_readings(space);
  find_readings(undecided);
  find_boxes(space, undecided);
  find_hidden_points(space);
  measure();
}

void ClearanceField::measure() {
  merge_points();
  measure_columns();
  tbb::parallel_for(0, count_[2], [this](int z) { measure_layer(z); });
}

void ClearanceField::build(std::span<const TriangleMesh> surfaces_B,
                           const Eigen::Vector3d& middle_B_m, double reach_m) {
  begin(middle_B_m, reach_m);
  for (const TriangleMesh& mesh_B : surfaces_B) {
    for (const auto& [a, b, c] : mesh_B.triangles) {
      add_triangle({mesh_B.vertices_m[a].cast<double>(), mesh_B.vertices_m[b].cast<double>(),
                    mesh_B.vertices_m[c].cast<double>()});
    }
  }
  fill();
  measure();
  // It stays as it is: what it was made with may go.
  std::vector<std::uint8_t>().swap(may_);
  std::vector<std::uint64_t>().swap(boxes_);
  std::vector<std::uint8_t>().swap(along_z_);
}

void ClearanceField::add_triangle(const std::array<Eigen::Vector3d, 3>& corners_B_m) {
  Eigen::AlignedBox3d box_m;
  for (const Eigen::Vector3d& corner_B_m : corners_B_m) box_m.extend(corner_B_m);
  if (is_beyond(box_m.center(), box_m.sizes().maxCoeff() / 2)) return;
  std::size_t longest = 0;
  std::array<double, 3> edge_m;
  for (std::size_t i = 0; i < 3; ++i) {
    edge_m[i] = (corners_B_m[(i + 1) % 3] - corners_B_m[i]).norm();
    if (edge_m[i] > edge_m[longest]) longest = i;
  }
  if (edge_m[longest] > kBox_m) {
    const std::size_t next = (longest + 1) % 3;
    std::array<Eigen::Vector3d, 3> first = corners_B_m, second = corners_B_m;
    first[next] = second[longest] = (corners_B_m[longest] + corners_B_m[next]) / 2;
    add_triangle(first);
    return add_triangle(second);
  }
  // Meshes are floats.
  constexpr double kRounding_m = 1e-6;
  const Eigen::Array3d low = (box_m.min() - low_B_m_).array() - kRounding_m;
  const Eigen::Array3d high = (box_m.max() - low_B_m_).array() + kRounding_m;
  const Eigen::Array3i from = (low / kBox_m).floor().cast<int>(),
                       to = (high / kBox_m).floor().cast<int>();
  for (int z = from.z(); z <= to.z(); ++z) {
    for (int y = from.y(); y <= to.y(); ++y) {
      for (int x = from.x(); x <= to.x(); ++x) {
        const Cell cell{x >> 2, y >> 2, z >> 2};
        if (!has(cell)) continue;
        const int bit = 16 * (z & 3) + 4 * (y & 3) + (x & 3);
        boxes_[place(cell[0], cell[1], cell[2])] |= std::uint64_t{1} << bit;
      }
    }
  }
  const Eigen::Vector3d middle_B_m = (corners_B_m[0] + corners_B_m[1] + corners_B_m[2]) / 3;
  take_point(middle_B_m, [](const Eigen::Vector3d&) { return true; });
}

bool ClearanceField::spread(std::size_t cell, std::uint64_t from,
                            std::vector<std::uint64_t>& outside) const {
  const std::uint64_t before = outside[cell], free = ~boxes_[cell];
  std::uint64_t now = before | (from & free);
  for (std::uint64_t last = 0; now != last;) {
    last = now;
    now |= ((now & ~kLastX) << 1 | (now & ~kFirstX) >> 1 | (now & ~kLastY) << 4 |
            (now & ~kFirstY) >> 4 | now << 16 | now >> 16) &
           free;
  }
  outside[cell] = now;
  return now != before;
}

void ClearanceField::fill() {
  std::vector<std::uint64_t> outside(boxes_.size(), 0);
  std::vector<Cell> open;
  const auto enter = [&](const Cell& cell, std::uint64_t from) {
    if (has(cell) && spread(place(cell[0], cell[1], cell[2]), from, outside)) open.push_back(cell);
  };
  for (int z = 0; z < count_[2]; ++z) {
    for (int y = 0; y < count_[1]; ++y) {
      const bool is_end = z == 0 || y == 0 || z == count_[2] - 1 || y == count_[1] - 1;
      for (int x = 0; x < count_[0]; x += is_end ? 1 : count_[0] - 1) enter({x, y, z}, kAllBoxes);
    }
  }
  while (!open.empty()) {
    const auto [x, y, z] = open.back();
    open.pop_back();
    const std::uint64_t from = outside[place(x, y, z)];
    enter({x + 1, y, z}, from >> 3 & kFirstX);
    enter({x - 1, y, z}, (from & kFirstX) << 3);
    enter({x, y + 1, z}, from >> 12 & kFirstY);
    enter({x, y - 1, z}, (from & kFirstY) << 12);
    enter({x, y, z + 1}, from >> 48 & kFirstZ);
    enter({x, y, z - 1}, (from & kFirstZ) << 48);
  }
  for (std::size_t i = 0; i < boxes_.size(); ++i) boxes_[i] = ~outside[i];
}

void ClearanceField::find_hidden(const UnknownSpace& space, const mesh::Cube& cube) {
  const int up = 2 * (cube.level - kCell);
  const std::array<int, 3> at{cube.x, cube.y, cube.z};
  for (int k = 0; k < 3; ++k) {
    if ((at[k] + 1) << up <= first_[k] || at[k] << up >= first_[k] + count_[k]) return;
  }
  const double half_m = cube.edge_m() / 2;
  if (is_beyond(cube.corner_m().array() + half_m, half_m)) return;
  if (cube.level == kCell) {
    may_[place(cube.x - first_[0], cube.y - first_[1], cube.z - first_[2])] |= kHidden;
    return;
  }
  for (std::uint64_t left = space.find_block(cube); left != 0; left &= left - 1) {
    find_hidden(space, cube.child(__builtin_ctzll(left)));
  }
}

void ClearanceField::find_readings(const UnknownSpace& space) {
  for (const FreeingCamera& view : space.views()) {
    const DepthView depth_m = view.space->obstacle_depth_m;
    for (int v = 0; v < depth_m.height; ++v) {
      // Where the reading before this one was marked: most are in the same cells.
      std::array<Cell, 4> last{};
      for (int u = 0; u < depth_m.width; ++u) {
        if (!std::isnan(depth_m(u, v))) add_reading(view, u, v, depth_m(u, v), last);
      }
    }
  }
}

void ClearanceField::add_reading(const FreeingCamera& view, int u, int v, float depth_m,
                                 std::array<Cell, 4>& last) {
  const Camera& camera = view.space->camera;
  const double thickness_m = view.space->settings.surface_thickness_m;
  const Eigen::Vector3d ray_B = view.X_BC.linear() * point_at(camera, u, v, 1);
  const Eigen::Vector3d near_B_m = view.X_BC.translation() + depth_m * ray_B;
  const double most_m = outer_m() + thickness_m * ray_B.norm();
  if ((near_B_m - middle_B_m_).squaredNorm() > most_m * most_m) return;
  // Two halves of the block that the pixel measured, each in a box.
  const double wide_m = (depth_m + thickness_m) / std::min(camera.fx_px, camera.fy_px);
  const Eigen::Vector3d half_B_m = thickness_m / 4 * ray_B.cwiseAbs();
  std::array<Cell, 4> cells;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d p_B_m = near_B_m + thickness_m * (i == 0 ? 0.25 : 0.75) * ray_B;
    cells[2 * i] = cell_of((p_B_m - half_B_m).array() - wide_m);
    cells[2 * i + 1] = cell_of((p_B_m + half_B_m).array() + wide_m);
  }
  if (cells == last) return;
  last = cells;
  for (std::size_t i = 0; i < 2; ++i) mark_read(cells[2 * i], cells[2 * i + 1]);
  // A little behind the front: rounded to a step, it may not be occupied before it.
  constexpr double kBehind_m = 0.001;
  const Eigen::Vector3d point_B_m = near_B_m + std::min(kBehind_m, thickness_m / 2) * ray_B;
  take_point(point_B_m, [&](const Eigen::Vector3d& p_B_m) { return has_read(view, p_B_m); });
}

void ClearanceField::mark_read(const Cell& low, const Cell& high) {
  for (int z = std::max(0, low[2]); z <= std::min(high[2], count_[2] - 1); ++z) {
    for (int y = std::max(0, low[1]); y <= std::min(high[1], count_[1] - 1); ++y) {
      for (int x = std::max(0, low[0]); x <= std::min(high[0], count_[0] - 1); ++x) {
        may_[place(x, y, z)] |= kRead;
      }
    }
  }
}

template <class Holds>
bool ClearanceField::take_point(const Eigen::Vector3d& p_B_m, const Holds& holds) {
  const Cell cell = cell_of(p_B_m);
  if (!has(cell)) return false;
  std::uint32_t& point = point_[0][place(cell[0], cell[1], cell[2])];
  if (point != kNoPoint) return true;
  Cell steps;
  Eigen::Vector3d rounded_B_m;
  for (int k = 0; k < 3; ++k) {
    const double in_cell_m = p_B_m[k] - low_B_m_[k] - cell[k] * kCell_m;
    steps[k] = std::clamp(static_cast<int>(in_cell_m / kStep_m), 0, kStepsPerCell - 1);
    rounded_B_m[k] = low_B_m_[k] + cell[k] * kCell_m + (steps[k] + 0.5) * kStep_m;
  }
  if (!holds(rounded_B_m)) return false;
  point = packed(steps);
  return true;
}

bool ClearanceField::is_inside(int x, int y, int z) const {
  for (int i = 0; i < 27; ++i) {
    const Cell at{x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1};
    if (has(at) && (may_[place(at[0], at[1], at[2])] & kHidden) == 0) return false;
  }
  return true;
}

void ClearanceField::find_boxes(const UnknownSpace& space, const UnknownSpace& undecided) {
  tbb::parallel_for(0, count_[2], [&](int z) {
    for (int y = 0; y < count_[1]; ++y) {
      for (int x = 0; x < count_[0]; ++x) {
        const std::size_t at = place(x, y, z);
        if (may_[at] == 0) continue;
        // Where no place is asked about, the cell as a whole will do.
        const Eigen::Vector3d p_B_m =
            low_B_m_ + kCell_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
        if ((p_B_m - middle_B_m_).norm() > reach_m_ + kCell_m || is_inside(x, y, z)) {
          boxes_[at] = kAllBoxes;
          continue;
        }
        const mesh::Cube cube = cube_of(x, y, z);
        if ((may_[at] & kHidden) != 0) boxes_[at] = space.find_block(cube);
        if ((may_[at] & kRead) == 0 || boxes_[at] == kAllBoxes) continue;
        boxes_[at] |= mesh::find_occupied(space.views(), cube);
        boxes_[at] |= mesh::find_occupied(undecided.views(), cube);
      }
    }
  });
}

void ClearanceField::find_hidden_points(const UnknownSpace& space) {
  const auto is_hidden = [&](const Eigen::Vector3d& p_B_m) {
    return space.hiding_pixel(p_B_m).has_value();
  };
  tbb::parallel_for(0, count_[2], [&](int z) {
    for (int y = 0; y < count_[1]; ++y) {
      for (int x = 0; x < count_[0]; ++x) {
        const std::size_t at = place(x, y, z);
        if ((may_[at] & kHidden) == 0 || point_[0][at] != kNoPoint) continue;
        const Eigen::Vector3d low_B_m = low_B_m_ + kCell_m * Eigen::Vector3d(x, y, z);
        if (take_point(low_B_m.array() + kCell_m / 2, is_hidden)) continue;
        // One box in each direction from the middle, where it may hold something.
        for (int i = 0; i < 8; ++i) {
          const int bx = i & 1 ? 3 : 0, by = i & 2 ? 3 : 0, bz = i & 4 ? 3 : 0;
          if ((boxes_[at] >> (16 * bz + 4 * by + bx) & 1) == 0) continue;
          const Eigen::Vector3d in_cell(bx + 0.5, by + 0.5, bz + 0.5);
          if (take_point(low_B_m + kBox_m * in_cell, is_hidden)) break;
        }
      }
    }
  });
}

void ClearanceField::merge_points() {
  point_[1].assign(static_cast<std::size_t>(half_count_[0]) * half_count_[1] * half_count_[2],
                   kNoPoint);
  for (int z = 0; z < count_[2]; ++z) {
    for (int y = 0; y < count_[1]; ++y) {
      for (int x = 0; x < count_[0]; ++x) {
        const std::uint32_t point = point_[0][place(x, y, z)];
        if (point == kNoPoint) continue;
        const auto row = static_cast<std::size_t>(z / 2) * half_count_[1] + y / 2;
        Cell steps = unpacked(point);
        const Cell odd{x & 1, y & 1, z & 1};
        for (int k = 0; k < 3; ++k) steps[k] += odd[k] * kStepsPerCell;
        point_[1][row * half_count_[0] + x / 2] = packed(steps);
      }
    }
  }
}

void ClearanceField::measure_columns() {
  const std::size_t width = 4 * static_cast<std::size_t>(count_[0]);
  const std::size_t layer = width * 4 * count_[1];
  along_z_.assign(layer * count_[2], 0);
  tbb::parallel_for(0, count_[1], [&](int y) {
    const auto [begin, end] = near_cells(0, y);
    // What lies beyond the grid counts as occupied.
    std::vector<Columns> behind(count_[0], Columns{});
    const auto rows_at = [&](int z) {
      return &along_z_[layer * z + 4 * static_cast<std::size_t>(y) * width];
    };
    const auto [bottom, top] = near_cells(2, y);
    for (int z = bottom; z < top; ++z) {
      std::uint8_t* const rows = rows_at(z);
      for (int x = begin; x < end; ++x) {
        for (std::size_t row = 0; row < 4; ++row) {
          const std::uint32_t four = row_of(behind[x], row);
          std::memcpy(rows + row * width + 4 * x, &four, 4);
        }
        pass(boxes_[place(x, y, z)], true, behind[x]);
      }
    }
    std::ranges::fill(behind, Columns{});
    for (int z = top - 1; z >= bottom; --z) {
      std::uint8_t* const rows = rows_at(z);
      for (int x = begin; x < end; ++x) {
        pass(boxes_[place(x, y, z)], false, behind[x]);
        for (std::size_t row = 0; row < 4; ++row) {
          const std::uint32_t four = row_of(behind[x], row);
          std::array<std::uint8_t, 4> bytes;
          std::memcpy(bytes.data(), &four, 4);
          std::uint8_t* const out = rows + row * width + 4 * x;
          for (std::size_t k = 0; k < 4; ++k) out[k] = std::min(out[k], bytes[k]);
        }
      }
    }
  });
}

std::array<int, 2> ClearanceField::in_ball(int axis, double most_m, double a_m, double b_m) const {
  const double square_m2 = most_m * most_m - a_m * a_m - b_m * b_m;
  if (square_m2 <= 0) return {0, 0};
  const double half_m = std::sqrt(square_m2), to_middle_m = middle_B_m_[axis] - low_B_m_[axis];
  return {std::max(0, static_cast<int>((to_middle_m - half_m) / kCell_m)),
          std::min(count_[axis], static_cast<int>((to_middle_m + half_m) / kCell_m) + 2)};
}

std::array<int, 2> ClearanceField::near_cells(int axis, int y) const {
  const double y_m = low_B_m_.y() + kCell_m * (y + 0.5) - middle_B_m_.y();
  return in_ball(axis, outer_m(), y_m, 0);
}

std::array<int, 2> ClearanceField::asked_nodes(int y, int z) const {
  // A place lies between nodes that are a cell farther off at most.
  const Eigen::Vector3d row_m = low_B_m_ + kCell_m * Eigen::Vector3d(0, y, z) - middle_B_m_;
  return in_ball(0, reach_m_ + 2 * kCell_m, row_m.y(), row_m.z());
}

void ClearanceField::measure_layer(int z) {
  using Squares = std::vector<std::int16_t>;
  // Signed: the oldest instruction sets have the lesser of two such numbers alone.
  constexpr std::int16_t kMost = kRangeBoxes * kRangeBoxes;
  const auto [low, high] = in_ball(2, reach_m_ + 2 * kCell_m, 0, 0);
  if (z < low || z >= high) {
    std::fill_n(&squared_[place(0, 0, z)], count_[0] * count_[1], std::uint16_t{0});
    return;
  }
  const int width = 4 * count_[0], height = 4 * count_[1];
  const std::uint8_t* const along_z = &along_z_[static_cast<std::size_t>(width) * height * z];
  Squares layer(static_cast<std::size_t>(width) * height);
  std::vector<bool> is_empty(static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    std::int16_t least = kMost;
    for (int x = 0; x < width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * width + x;
      layer[at] = static_cast<std::int16_t>(along_z[at] * along_z[at]);
      least = std::min(least, layer[at]);
    }
    is_empty[y] = least == kMost;
  }
  // Of one row of nodes: each column by itself, in four parts, so that a part has one number for
  // each node.
  std::array<Squares, 4> column;
  for (Squares& part : column) part.resize(count_[0]);
  Squares row(width);
  for (int y = 0; y < count_[1]; ++y) {
    std::uint16_t* const out = &squared_[place(0, y, z)];
    const auto [begin, end] = asked_nodes(y, z);
    if (begin >= end) {
      std::fill_n(out, count_[0], std::uint16_t{0});
      continue;
    }
    std::ranges::fill(row, kMost);
    each_beside(4 * y, height, [&](int at, int d) {
      if (is_empty[at]) return;
      const auto square = static_cast<std::int16_t>(d * d);
      const std::int16_t* const from = &layer[static_cast<std::size_t>(at) * width];
      for (int x = 0; x < width; ++x) {
        row[x] = std::min(row[x], static_cast<std::int16_t>(from[x] + square));
      }
    });
    for (int x = 0; x < width; ++x) column[x & 3][x >> 2] = row[x];
    Squares least(count_[0], kMost);
    for (int d = 0; d < kRangeBoxes; ++d) {
      const auto square = static_cast<std::int16_t>(d * d);
      // Boxes d behind each node, and d before it.
      const std::int16_t* const behind = column[d & 3].data();
      const std::int16_t* const before = column[3 - (d & 3)].data();
      const int far = d >> 2;
      for (int x = begin; x < std::min(end, count_[0] - far); ++x) {
        least[x] = std::min(least[x], static_cast<std::int16_t>(behind[x + far] + square));
      }
      for (int x = std::max(begin, far + 1); x < end; ++x) {
        least[x] = std::min(least[x], static_cast<std::int16_t>(before[x - far - 1] + square));
      }
    }
    // Of what is farther from the middle, nobody asks and nothing is known.
    std::fill_n(out, count_[0], std::uint16_t{0});
    std::copy(least.begin() + begin, least.begin() + end, out + begin);
  }
}

ClearanceField::Bounds ClearanceField::at(const Eigen::Vector3d& p_B_m) const {
  const Cell cell = cell_of(p_B_m);
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k) {
    if (cell[k] < 0 || cell[k] + 1 >= count_[k]) return {0, kInfinity};
  }
  const Eigen::Vector3d t =
      (p_B_m - low_B_m_) / kCell_m - Eigen::Vector3d(cell[0], cell[1], cell[2]);
  double squared = -16 * t.dot(Eigen::Vector3d::Ones() - t);
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
    const double share =
        (x ? t.x() : 1 - t.x()) * (y ? t.y() : 1 - t.y()) * (z ? t.z() : 1 - t.z());
    squared += share * squared_[place(cell[0] + x, cell[1] + y, cell[2] + z)];
  }
  double upper_m = kInfinity;
  for (int i = 0; i < 27; ++i) {
    const Cell beside{cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
    if (!has(beside)) continue;
    const std::uint32_t point = point_[0][place(beside[0], beside[1], beside[2])];
    if (point == kNoPoint) continue;
    const Cell steps = unpacked(point);
    Eigen::Vector3d q_B_m;
    for (int k = 0; k < 3; ++k) {
      q_B_m[k] = low_B_m_[k] + beside[k] * kCell_m + (steps[k] + 0.5) * kStep_m;
    }
    upper_m = std::min(upper_m, (q_B_m - p_B_m).norm());
  }
  return {static_cast<float>(kBox_m * std::sqrt(std::max(0.0, squared))),
          static_cast<float>(upper_m)};
}

ClearanceField::Grid ClearanceField::grid() const {
  return {low_B_m_.cast<float>(),
          count_,
          squared_.data(),
          {point_[0].data(), point_[1].data()},
          {count_, half_count_}};
}

}  // namespace berth
