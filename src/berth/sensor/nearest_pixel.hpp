#pragma once

#include <vector>

#include "berth/types/image.hpp"

namespace berth {

struct NearestPixelWorkspace {
  /// Of each pixel, the nearest one with a depth in its own column: how many rows away, and its
  /// depth; NaN where the column has none.
  Image<int> rows;
  DepthImage depth_m;
  /// Of each row of the image: the columns that are nearest to some pixel without depth in it, from
  /// left to right, and the last u where each is.
  struct Column {
    int u;
    int last_u;
  };
  std::vector<std::vector<Column>> columns;
};

/// Writes to `nearest_m` the depth of the nearest pixel that has one (Euclidean in the image; of
/// several equally near the least depth), NaN where no pixel has one. In linear time by columns,
/// then rows (Meijster, Roerdink, Hesselink 2000), on all threads that TBB gives.
void find_nearest_depth(const DepthImage& depth_m, NearestPixelWorkspace& workspace,
                        DepthImage& nearest_m);

}  // namespace berth
