// The inner loop of search_around.
#pragma once

#include <cstddef>

namespace berth {

/// A robot pixel, and the depths of obstacles that count around it.
struct WatchedPixel {
  float u;
  float v;
  float depth_m;
  float depth_lo_m;
  float depth_hi_m;
};

/// A run of obstacle pixels in the image: depth i lies at depth_m[i * stride].
struct DepthRun {
  float u;
  float v;
  float du;
  float dv;
  const float* depth_m;
  std::ptrdiff_t stride;
  int count;
};

/// The least D^2 of a run, +inf if there is none, and the number of pairs.
struct LeastOfRun {
  float squared_m2;
  int pairs;
};

}  // namespace berth
