// What is left of free space after something may have moved.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The memory of age_free_depth().
struct AgingWorkspace {
  /// Some columns of a row.
  struct Part {
    int begin = 0;
    int end = 0;

    bool is_empty() const { return end <= begin; }
  };
  /// The same in blocks of columns.
  struct Blocks {
    std::int16_t begin = 0;
    std::int16_t end = 0;
  };

  /// How many pixels beside it each pixel holds, at most the number of rings and one.
  Image<std::uint8_t> reach;
  /// Bit r of a block of a row: some pixel's reach is r. Row by row.
  std::vector<std::uint32_t> reaches;
  /// Of each row those blocks that have pixels of a ring, ring by ring.
  std::vector<Blocks> ring_blocks;
  /// Three rows of each ring, and a row to work on.
  std::vector<float> rows;
  /// What of each of them is touched.
  std::vector<Part> parts;
  /// What each pixel of a row has left, and how many pixels beside it it holds; 0 where rings do
  /// it.
  std::vector<float> left_m;
  std::vector<int> far_reach;
  /// levels[k]: values that hold in squares of 2^k x 2^k pixels, by their first pixel.
  std::vector<DepthImage> levels;
};

/// E after something may have moved by `moved_m`: each pixel has that much less left, and what a
/// pixel with a reading S has left holds for all that are no more than ceil(f moved_m / S) pixels
/// from it sideways, f the greater of both focal lengths. Of that, the least of 3 x 3 pixels is
/// free (find_free_depth).
void age_free_depth(const Camera& camera, const DepthImage& sensor_depth_m, const DepthImage& own_m,
                    double moved_m, AgingWorkspace& workspace, DepthImage& out);

}  // namespace berth
