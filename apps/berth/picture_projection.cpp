#include "apps/berth/picture_projection.hpp"

namespace berth::app {

std::vector<PictureLink> projected(const Camera& camera, const Pose& X_BC,
                                   const std::vector<LinkResult>& links) {
  const Pose X_CB = X_BC.inverse();
  std::vector<PictureLink> shown;
  for (const LinkResult& link : links) {
    PictureLink& one = shown.emplace_back(PictureLink{link, {}});
    if (!link.has_distance()) continue;
    const auto pixel_at = [&](const Eigen::Vector3f& p_B_m) {
      return pixel_of(camera, X_CB * p_B_m.cast<double>()).value_or(Pixel{});
    };
    one.robot_pixel = pixel_at(link.robot_point_B_m);
    one.obstacle_pixel = pixel_at(link.obstacle_point_B_m);
  }
  return shown;
}

}  // namespace berth::app
