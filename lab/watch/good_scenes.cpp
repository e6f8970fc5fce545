#include "lab/watch/good_scenes.hpp"

#include "lab/watch/hidden_image.hpp"
#include "lab/watch/mistakes.hpp"
#include "sim/random.hpp"

namespace berth::lab {
namespace {

Eigen::Vector3d direction(sim::Random& random) {
  for (;;) {
    const Eigen::Vector3d v(random(-1, 1), random(-1, 1), random(-1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

}  // namespace

void move_camera(OpenScene& scene, std::size_t c, double offset_m, double angle_rad,
                 std::uint32_t seed) {
  sim::Random random(300 + seed);
  CameraMount mount = scene.cameras[c].view->mount();
  const Eigen::Vector3d offset = offset_m * direction(random);
  mount.X_PC =
      mount.X_PC * Eigen::Translation3d(offset) * Eigen::AngleAxisd(angle_rad, direction(random));
  set_mount(scene, scene.cameras[c], mount);
}

void hide_robot(OpenScene& scene, std::size_t c, std::uint32_t seed) {
  OpenCamera& camera = scene.cameras[c];
  const HiddenImage hidden = hidden_image(camera, seed);
  const std::size_t k = hidden.frame;
  camera.at_exposure = {camera.at_exposure[k]};
  camera.exposure_time = {camera.exposure_time[k]};
  camera.kept_depth_m = {std::make_shared<const DepthImage>(hidden.depth_m)};
  camera.source.depth = {camera.source.depth[k]};
}

}  // namespace berth::lab
