#include "apps/berth/picture_projection.hpp"

namespace berth::app {

void project_pairs(const Camera& camera, const Pose& X_BC, std::vector<LinkResult>& links) {
  const Pose X_CB = X_BC.inverse();
  for (LinkResult& link : links) {
    if (!link.has_distance()) continue;
    const auto pixel_at = [&](const Eigen::Vector3f& p_B_m) {
      return pixel_of(camera, X_CB * p_B_m.cast<double>()).value_or(Pixel{});
    };
    link.image.robot_pixel = pixel_at(link.robot_point_B_m);
    link.obstacle_pixel = pixel_at(link.obstacle_point_B_m);
  }
}

}  // namespace berth::app
