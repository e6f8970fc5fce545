#include "berth/sensor/nearest_pixel.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <tuple>

namespace berth {
namespace {

using Column = NearestPixelWorkspace::Column;

void look_down_columns(const DepthImage& depth_m, NearestPixelWorkspace& workspace) {
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const bool has_depth = !std::isnan(depth_m(u, v));
      const bool is_first = v == 0 || has_depth;
      workspace.rows(u, v) = is_first ? 0 : workspace.rows(u, v - 1) + 1;
      workspace.depth_m(u, v) = is_first ? depth_m(u, v) : workspace.depth_m(u, v - 1);
    }
  }
}

void look_up_columns(NearestPixelWorkspace& workspace) {
  Image<int>& rows = workspace.rows;
  DepthImage& depth_m = workspace.depth_m;
  for (int v = depth_m.height() - 2; v >= 0; --v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const int below = rows(u, v + 1) + 1;
      const float below_m = depth_m(u, v + 1);
      if (std::isnan(below_m)) continue;
      if (std::isnan(depth_m(u, v)) ||
          std::tie(below, below_m) < std::tie(rows(u, v), depth_m(u, v))) {
        rows(u, v) = below;
        depth_m(u, v) = below_m;
      }
    }
  }
}

/// Which of two columns a row's pixels are nearer to: up to some u it is the left one.
class Row {
 public:
  Row(const NearestPixelWorkspace& workspace, int v)
      : rows_(workspace.rows.row(v)), depth_m_(workspace.depth_m.row(v)) {}

  bool has_depth(int column) const { return !std::isnan(depth_m_[column]); }
  float depth_m(int column) const { return depth_m_[column]; }
  /// Whether the pixel itself has a depth.
  bool is_reading(int column) const { return rows_[column] == 0 && has_depth(column); }

  bool is_nearer(int left, int right, int u) const {
    return std::tuple(squared_px(left, u), depth_m_[left]) <=
           std::tuple(squared_px(right, u), depth_m_[right]);
  }

  /// The last u of which the left column is nearer; may lie beside the image.
  int last_u(int left, int right) const {
    const std::int64_t gap = right - left;
    const std::int64_t sum = squared_px(right, 0) - squared_px(left, 0);
    // Equally near at u = sum / (2 gap).
    std::int64_t u = sum / (2 * gap) - (sum % (2 * gap) < 0 ? 1 : 0);
    if (u * 2 * gap == sum && !(depth_m_[left] <= depth_m_[right])) --u;
    return static_cast<int>(u);
  }

 private:
  std::int64_t squared_px(int column, int u) const {
    const std::int64_t du = column - u;
    const std::int64_t dv = rows_[column];
    return du * du + dv * dv;
  }

  const int* rows_;
  const float* depth_m_;
};

void find_in_row(const Row& row, int width, std::vector<Column>& columns, float* nearest_m) {
  columns.clear();
  columns.reserve(static_cast<std::size_t>(width));
  for (int u = 0; u < width; ++u) {
    if (!row.has_depth(u)) continue;
    // Amid readings it is nearest to no other pixel.
    if (row.is_reading(u) && u > 0 && row.is_reading(u - 1) && u + 1 < width &&
        row.is_reading(u + 1)) {
      continue;
    }
    // A column that loses already where its own stretch begins is nearest nowhere.
    while (columns.size() > 1 &&
           !row.is_nearer(columns.back().u, u, columns[columns.size() - 2].last_u + 1))
      columns.pop_back();
    if (columns.size() == 1 && !row.is_nearer(columns.back().u, u, 0)) columns.pop_back();
    if (!columns.empty()) columns.back().last_u = row.last_u(columns.back().u, u);
    if (columns.empty() || columns.back().last_u < width - 1) columns.push_back({u, width - 1});
  }
  std::size_t i = 0;
  for (int u = 0; u < width; ++u) {
    while (i + 1 < columns.size() && u > columns[i].last_u) ++i;
    if (row.is_reading(u)) {
      nearest_m[u] = row.depth_m(u);
    } else {
      nearest_m[u] = columns.empty() ? kNoDepth : row.depth_m(columns[i].u);
    }
  }
}

}  // namespace

void find_nearest_depth(const DepthImage& depth_m, NearestPixelWorkspace& workspace,
                        DepthImage& nearest_m) {
  const int width = depth_m.width();
  const int height = depth_m.height();
  workspace.rows.resize(width, height, 0);
  workspace.depth_m.resize(width, height, kNoDepth);
  workspace.columns.resize(static_cast<std::size_t>(height));
  nearest_m.resize(width, height, kNoDepth);
  look_down_columns(depth_m, workspace);
  look_up_columns(workspace);
  tbb::parallel_for(0, height, [&](int v) {
    find_in_row(Row(workspace, v), width, workspace.columns[static_cast<std::size_t>(v)],
                nearest_m.row(v));
  });
}

}  // namespace berth
