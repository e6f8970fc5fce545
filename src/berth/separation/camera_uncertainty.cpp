#include "berth/separation/camera_uncertainty.hpp"

#include <algorithm>

namespace berth {

double camera_uncertainty_m(const CameraSettings& settings, LinkId link, double depth_m) {
  const SelfFilterSettings& filter = settings.self_filter;
  const double z_m = std::max(0.0, depth_m);
  const double tolerance_m = filter.tolerance_m + filter.tolerance_per_m2 * z_m * z_m;
  return std::max(tolerance_m, filter.padding_of(link)) +
         settings.sensor.noise_m * std::max(1.0, z_m * z_m);
}

}  // namespace berth
