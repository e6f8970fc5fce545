#include "berth/space/clearance_field.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/space/blocks.hpp"

namespace berth {
namespace {

constexpr std::uint8_t kHidden = 1;
/// Of the readings of a view; some share one.
std::uint8_t kind_of(std::size_t view) { return static_cast<std::uint8_t>(2 << view % 7); }
constexpr double kStep_m = mesh::Cube::kLeastEdge_m;
constexpr int kStepsPerCell = 1 << 2 * ClearanceField::kCell;
constexpr std::uint64_t kAllBoxes = ~std::uint64_t{0};
/// The boxes of a cell at its ends along an axis.
constexpr std::uint64_t kFirstX = 0x1111'1111'1111'1111u, kLastX = kFirstX << 3;
constexpr std::uint64_t kFirstY = 0x000F'000F'000F'000Fu, kLastY = kFirstY << 12;
constexpr std::uint64_t kFirstZ = 0xFFFF;

/// Whether it is occupied by what this view has read (D4).
bool has_read(const FreeingCamera& view, const Eigen::Vector3d& p_B_m) {
  const Eigen::Vector3d p_C_m = view.X_CB * p_B_m;
  const auto pixel = pixel_of(view.space->camera, p_C_m);
  if (!pixel) return false;
  const double depth_m = view.space->obstacle_depth_m(pixel->u, pixel->v);
  return depth_m <= p_C_m.z() && p_C_m.z() <= depth_m + view.space->settings.surface_thickness_m;
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
    first_[k] = static_cast<int>(std::floor(low_m / kCell_m));
    count_[k] = 2 * static_cast<int>(std::ceil(half_m / kCell_m)) + 2;
    low_B_m_[k] = mesh::Cube::kCorner_m + first_[k] * kCell_m;
  }
  count_[0] = (count_[0] + BoxGrid::kRow - 1) / BoxGrid::kRow * BoxGrid::kRow;
  const auto cells = static_cast<std::size_t>(count_[0]) * count_[1] * count_[2];
  may_.assign(cells, 0);
  boxes_.resize(cells);
  point_.assign(cells, kNoPoint);
}

void ClearanceField::build(const UnknownSpace& space, const UnknownSpace& undecided,
                           const Eigen::Vector3d& middle_B_m, double reach_m) {
  begin(middle_B_m, reach_m);
  constexpr int kTop = kCell + 2, kUp = 2 * (kTop - kCell);
  const auto last = [&](int k) { return (first_[k] + count_[k] - 1) >> kUp; };
  tbb::parallel_for(first_[2] >> kUp, last(2) + 1, [&](int z) {
    for (int y = first_[1] >> kUp; y <= last(1); ++y) {
      for (int x = first_[0] >> kUp; x <= last(0); ++x) find_hidden(space, {kTop, x, y, z});
    }
  });
  find_readings(space);
  find_readings(undecided);
  find_boxes(space, undecided);
  measure();
}

void ClearanceField::measure() {
  const BoxGrid grid{count_, boxes_.data(), (middle_B_m_ - low_B_m_) / kCell_m,
                     reach_m_ / kCell_m + 2};
  distances_.find(grid, squared_);
}

void ClearanceField::build(std::span<const TriangleMesh> surfaces_B,
                           const Eigen::Vector3d& middle_B_m, double reach_m) {
  begin(middle_B_m, reach_m);
  std::ranges::fill(boxes_, 0);
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
  distances_ = {};
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
  if (cube.level == kCell) {
    may_[place(cube.x - first_[0], cube.y - first_[1], cube.z - first_[2])] = kHidden;
    return;
  }
  const double half_m = cube.edge_m() / 2;
  if (is_beyond(cube.corner_m().array() + half_m, half_m)) return;
  for (std::uint64_t left = space.find_block(cube); left != 0; left &= left - 1) {
    find_hidden(space, cube.child(__builtin_ctzll(left)));
  }
}

void ClearanceField::find_readings(const UnknownSpace& space) {
  constexpr int kBlock_px = 4;
  for (std::size_t k = 0; k < space.views().size(); ++k) {
    const FreeingCamera& view = space.views()[k];
    const DepthView depth_m = view.space->obstacle_depth_m;
    for (int v = 0; v < depth_m.height; v += kBlock_px) {
      for (int u = 0; u < depth_m.width; u += kBlock_px) {
        add_readings(view, kind_of(k),
                     {u, v, std::min(u + kBlock_px, depth_m.width),
                      std::min(v + kBlock_px, depth_m.height)});
      }
    }
  }
}

void ClearanceField::add_readings(const FreeingCamera& view, std::uint8_t kind,
                                  const PixelRect& pixels) {
  const Camera& camera = view.space->camera;
  const DepthView depth_m = view.space->obstacle_depth_m;
  const double thickness_m = view.space->settings.surface_thickness_m;
  float least_m = std::numeric_limits<float>::infinity(), most_m = 0;
  Pixel nearest;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      const float here_m = depth_m(u, v);
      if (here_m < least_m) least_m = here_m, nearest = {u, v};
      if (here_m > most_m) most_m = here_m;
    }
  }
  if (!(least_m <= most_m)) return;
  const auto ray = [&](double u, double v) -> Eigen::Vector3d {
    return view.X_BC.linear() *
           Eigen::Vector3d((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px, 1);
  };
  const Eigen::Vector3d ray_B = ray(nearest.u, nearest.v), eye_B_m = view.X_BC.translation();
  // A few pixels wide, it lies in the ball about its nearest reading that reaches its farthest.
  const double deep_m = most_m + thickness_m - least_m, far_m = most_m + thickness_m;
  const double wide_m = 8 * far_m / std::min(camera.fx_px, camera.fy_px);
  if (is_beyond(eye_B_m + least_m * ray_B, deep_m * ray_B.norm() + wide_m)) return;
  // Slices of depth, as thick as cells, and which of them have something.
  constexpr int kMostSlices = 64;
  const int slices = std::clamp(static_cast<int>(std::ceil(deep_m / kCell_m)), 1, kMostSlices);
  const double thick_m = deep_m / slices;
  std::uint64_t filled = 0;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      const double from_m = depth_m(u, v) - least_m;
      if (std::isnan(from_m)) continue;
      const int first = std::min(static_cast<int>(from_m / thick_m), slices - 1);
      const int last = std::min(static_cast<int>((from_m + thickness_m) / thick_m), slices - 1);
      filled |= (~std::uint64_t{0} >> (63 - (last - first))) << first;
    }
  }
  constexpr double kRounding_px = 1e-3, kRounding_m = 1e-5;
  const double u0 = pixels.u_begin - 0.5 - kRounding_px, u1 = pixels.u_end - 0.5 + kRounding_px;
  const double v0 = pixels.v_begin - 0.5 - kRounding_px, v1 = pixels.v_end - 0.5 + kRounding_px;
  const std::array<Eigen::Vector3d, 4> rays_B{ray(u0, v0), ray(u1, v0), ray(u0, v1), ray(u1, v1)};
  for (; filled != 0; filled &= filled - 1) {
    const int i = __builtin_ctzll(filled);
    Eigen::AlignedBox3d box_B_m;
    for (const Eigen::Vector3d& corner_B : rays_B) {
      box_B_m.extend(eye_B_m + (least_m + i * thick_m - kRounding_m) * corner_B);
      box_B_m.extend(eye_B_m + (least_m + (i + 1) * thick_m + kRounding_m) * corner_B);
    }
    mark_read(kind, cell_of(box_B_m.min()), cell_of(box_B_m.max()));
  }
  // A little behind the front: rounded to a step, it may not be occupied before it.
  constexpr double kBehind_m = 0.001;
  const Eigen::Vector3d point_B_m =
      eye_B_m + (least_m + std::min(kBehind_m, thickness_m / 2)) * ray_B;
  take_point(point_B_m, [&](const Eigen::Vector3d& p_B_m) { return has_read(view, p_B_m); });
}

void ClearanceField::mark_read(std::uint8_t kind, const Cell& low, const Cell& high) {
  for (int z = std::max(0, low[2]); z <= std::min(high[2], count_[2] - 1); ++z) {
    for (int y = std::max(0, low[1]); y <= std::min(high[1], count_[1] - 1); ++y) {
      for (int x = std::max(0, low[0]); x <= std::min(high[0], count_[0] - 1); ++x) {
        may_[place(x, y, z)] |= kind;
      }
    }
  }
}

template <class Holds>
bool ClearanceField::take_point(const Eigen::Vector3d& p_B_m, const Holds& holds) {
  const Cell cell = cell_of(p_B_m);
  if (!has(cell)) return false;
  std::uint32_t& point = point_[place(cell[0], cell[1], cell[2])];
  if (point != kNoPoint) return true;
  Cell steps;
  Eigen::Vector3d rounded_B_m;
  for (int k = 0; k < 3; ++k) {
    const double in_cell_m = p_B_m[k] - low_B_m_[k] - cell[k] * kCell_m;
    steps[k] = std::clamp(static_cast<int>(in_cell_m / kStep_m), 0, kStepsPerCell - 1);
    rounded_B_m[k] = low_B_m_[k] + cell[k] * kCell_m + (steps[k] + 0.5) * kStep_m;
  }
  if (!holds(rounded_B_m)) return false;
  point = static_cast<std::uint32_t>(steps[0] | steps[1] << 10 | steps[2] << 20);
  return true;
}

void ClearanceField::find_inside(int y, int z, std::vector<std::uint8_t>& inside) const {
  const auto count = static_cast<std::size_t>(count_[0]);
  // Of each column of nine cells, and a column beyond each end.
  inside.assign(count + 2, kHidden);
  std::uint8_t* const columns = inside.data();
  for (int i = 0; i < 9; ++i) {
    const int beside_y = y + i % 3 - 1, beside_z = z + i / 3 - 1;
    if (!has({0, beside_y, beside_z})) continue;
    const std::uint8_t* const row = &may_[place(0, beside_y, beside_z)];
    for (std::size_t x = 0; x < count; ++x) columns[x + 1] &= row[x];
  }
  // From below, so that what is read has not been written yet.
  for (std::size_t x = 0; x < count; ++x) columns[x] &= columns[x + 1] & columns[x + 2];
}

std::uint64_t ClearanceField::boxes_with_readings(const UnknownSpace& space, std::size_t at,
                                                  const mesh::Cube& cube) const {
  std::uint64_t boxes = 0;
  for (std::size_t k = 0; k < space.views().size() && boxes != kAllBoxes; ++k) {
    if ((may_[at] & kind_of(k)) == 0) continue;
    boxes |= mesh::find_occupied(space.views().subspan(k, 1), cube);
  }
  return boxes;
}

void ClearanceField::find_boxes(const UnknownSpace& space, const UnknownSpace& undecided) {
  tbb::parallel_for(0, count_[2], [&](int z) {
    std::vector<std::uint8_t> inside;
    for (int y = 0; y < count_[1]; ++y) {
      find_inside(y, z, inside);
      for (int x = 0; x < count_[0]; ++x) {
        const std::size_t at = place(x, y, z);
        boxes_[at] = 0;
        if (may_[at] == 0) continue;
        // Where no place is asked about, the cell as a whole will do.
        const Eigen::Vector3d p_B_m =
            low_B_m_ + kCell_m * Eigen::Vector3d(x + 0.5, y + 0.5, z + 0.5);
        boxes_[at] = kAllBoxes;
        if ((p_B_m - middle_B_m_).squaredNorm() > (reach_m_ + kCell_m) * (reach_m_ + kCell_m)) {
          continue;
        }
        const mesh::Cube cube = cube_of(x, y, z);
        if (inside[x] == 0) {
          boxes_[at] = (may_[at] & kHidden) != 0 ? space.find_block(cube) : 0;
          if (boxes_[at] != kAllBoxes) boxes_[at] |= boxes_with_readings(space, at, cube);
          if (boxes_[at] != kAllBoxes) boxes_[at] |= boxes_with_readings(undecided, at, cube);
        } else if (((x | y | z) & 1) != 0) {
          // Among the cells around any place one has a point then.
          continue;
        }
        if ((may_[at] & kHidden) != 0) find_hidden_point(space, {x, y, z});
      }
    }
  });
}

void ClearanceField::find_hidden_point(const UnknownSpace& space, const Cell& cell) {
  const auto [x, y, z] = cell;
  const std::size_t at = place(x, y, z);
  if (point_[at] != kNoPoint) return;
  const Eigen::Vector3d low_B_m = low_B_m_ + kCell_m * Eigen::Vector3d(x, y, z);
  const auto takes = [&](const Eigen::Vector3d& in_cell_m) {
    return take_point(low_B_m + in_cell_m, [&](const Eigen::Vector3d& p_B_m) {
      return space.hiding_pixel(p_B_m).has_value();
    });
  };
  const std::uint64_t boxes = boxes_[at];
  if (boxes == kAllBoxes) {
    takes(Eigen::Vector3d::Constant(kCell_m / 2));
    return;
  }
  // One box in each layer: first of those beside free ones, for what is near to be found near.
  const std::uint64_t inner = boxes & (boxes << 1 | kFirstX) & (boxes >> 1 | kLastX) &
                              (boxes << 4 | kFirstY) & (boxes >> 4 | kLastY) &
                              (boxes << 16 | kFirstZ) & (boxes >> 16 | ~(kAllBoxes >> 16));
  for (const std::uint64_t some : {boxes & ~inner, inner}) {
    for (int i = 0; i < 4; ++i) {
      const std::uint64_t layer = some >> 16 * i & kFirstZ;
      if (layer == 0) continue;
      const int first = __builtin_ctzll(layer);
      if (takes(kBox_m * Eigen::Vector3d((first & 3) + 0.5, (first >> 2) + 0.5, i + 0.5))) return;
    }
  }
}

ClearanceField::Grid ClearanceField::grid() const {
  return {low_B_m_.cast<float>(), count_, squared_.data(), point_.data()};
}

}  // namespace berth
