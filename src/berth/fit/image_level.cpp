#include "berth/fit/image_level.hpp"

namespace berth {
namespace {

/// The pixel that stands for the block of step x step pixels lies in its middle.
int middle_of(int step) { return step / 2; }

Camera thinned(const Camera& camera, int step) {
  const double middle = middle_of(step);
  return {camera.width_px / step, camera.height_px / step,        camera.fx_px / step,
          camera.fy_px / step,    (camera.cx_px - middle) / step, (camera.cy_px - middle) / step};
}

DepthImage thinned(const DepthImage& depth_m, int step) {
  DepthImage out(depth_m.width() / step, depth_m.height() / step);
  for (int v = 0; v < out.height(); ++v) {
    const float* from = depth_m.row(v * step + middle_of(step)) + middle_of(step);
    for (int u = 0; u < out.width(); ++u) out(u, v) = from[u * step];
  }
  return out;
}

}  // namespace

ImageLevel make_level(const CalibrationCamera& camera, int step) {
  ImageLevel level{step, thinned(camera.camera, step), {}};
  for (const CalibrationFrame& frame : camera.frames) {
    level.depth_m.push_back(thinned(frame.depth_m, step));
  }
  return level;
}

}  // namespace berth
