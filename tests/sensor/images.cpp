#include "tests/sensor/images.hpp"

#include <algorithm>
#include <cmath>

namespace berth {

ObstacleImage kept_image(const DepthImage& depth_m) {
  ObstacleImage image{depth_m, Image<PixelFate>(depth_m.width(), depth_m.height()), {}, {}};
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    if (std::isnan(depth_m.pixels()[i])) image.fate.pixels()[i] = PixelFate::no_reading;
  }
  return image;
}

DepthImage patchy_image(sim::Random& random) {
  DepthImage depth_m(random.whole(1, 40), random.whole(1, 30), kNoDepth);
  const double share = random(0, 1);
  for (float& z : depth_m.pixels()) {
    // Few depths, so that some are the same.
    if (random.chance(share)) z = 0.5F + 0.06F * static_cast<float>(random.whole(0, 8));
  }
  return depth_m;
}

}  // namespace berth
