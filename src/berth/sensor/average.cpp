#include "berth/sensor/average.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>

#include "berth/sensor/noise.hpp"

namespace berth {
namespace {

void remember(const DepthImage& depth_m, std::size_t frames, ReadingHistory& history) {
  const bool fits = history.depth_m.size() == frames &&
                    history.depth_m.front().width() == depth_m.width() &&
                    history.depth_m.front().height() == depth_m.height();
  if (!fits) {
    history.depth_m.assign(frames, DepthImage(depth_m.width(), depth_m.height(), kNoDepth));
  }
  history.newest = (history.newest + 1) % frames;
  history.depth_m[history.newest].pixels() = depth_m.pixels();
}

/// A row of each image, the newest first.
using Rows = std::array<const float*, kMostAverageFrames>;

Rows rows_of(const ReadingHistory& history, int v) {
  const std::size_t frames = history.depth_m.size();
  Rows rows{};
  for (std::size_t back = 0; back < frames; ++back)
    rows[back] = history.depth_m[(history.newest + frames - back) % frames].row(v);
  return rows;
}

float mean_m(const Rows& rows, std::size_t frames, int u, float noise_m) {
  const float reading_m = rows[0][u];
  float sum_m = reading_m;
  std::size_t count = 1;
  for (; count < frames; ++count) {
    const float z = rows[count][u];
    if (!(std::abs(z - reading_m) <= noise_m)) break;
    sum_m += z;
  }
  return sum_m / static_cast<float>(count);
}

}  // namespace

void average_readings(const SensorSettings& settings, ReadingHistory& history, ObstacleImage& out) {
  remember(out.depth_m, static_cast<std::size_t>(settings.average_frames), history);
  tbb::parallel_for(0, out.depth_m.height(), [&](int v) {
    const Rows rows = rows_of(history, v);
    for (int u = 0; u < out.depth_m.width(); ++u) {
      if (out.fate(u, v) != PixelFate::obstacle) continue;
      float& depth_m = out.depth_m(u, v);
      const float noise_m = grown_with_depth(static_cast<float>(settings.noise_m), depth_m);
      const float mean = mean_m(rows, history.depth_m.size(), u, noise_m);
      if (!(mean < depth_m)) continue;
      depth_m = mean;
      out.fate(u, v) = PixelFate::averaged;
    }
  });
}

}  // namespace berth
