#include "berth/render/view_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace berth {

const Camera& checked(const Camera& camera) {
  const bool focal_ok = camera.fx_px > 0 && camera.fy_px > 0 && std::isfinite(camera.fx_px) &&
                        std::isfinite(camera.fy_px);
  if (camera.width_px <= 0 || camera.height_px <= 0 || !focal_ok || !std::isfinite(camera.cx_px) ||
      !std::isfinite(camera.cy_px)) {
    throw std::invalid_argument(fmt::format(
        "camera: {} x {} px, fx {}, fy {}, cx {}, cy {}; expected a positive size and "
        "positive focal lengths, all finite",
        camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px));
  }
  return camera;
}

void require_finite(const Pose& X_BC) {
  if (X_BC.matrix().allFinite()) return;
  throw std::invalid_argument(fmt::format("pose of the camera at {} {} {}: expected finite numbers",
                                          X_BC.translation().x(), X_BC.translation().y(),
                                          X_BC.translation().z()));
}

}  // namespace berth
