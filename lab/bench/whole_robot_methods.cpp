#include "lab/bench/whole_robot_methods.hpp"

namespace berth::lab {

double ExactYardstick::ms(const WholeRobotScene& scene, int links) {
  const CameraImages& view = scene.views.front();
  searchable_.build(view.obstacles.depth_m);
  const ImageDistanceSettings settings{{.mean_direction = false}, {}};
  return least_ms(
      CLOCK_THREAD_CPUTIME_ID, [&] { distances_.links.clear(); },
      [&] {
        exact({scene.camera, view.robot, links, searchable_, settings}, workspace_, distances_);
      });
}

void SceneSpaces::build_view(const WholeRobotScene& scene, int k) {
  const CameraImages& view = scene.views[k];
  build_camera_space(scene.camera, view.depth_m, view.obstacles, {}, {}, spaces_[k]);
}

void SceneSpaces::build_all(const WholeRobotScene& scene) {
  for (int k = 0; k < kSceneCameras; ++k) build_view(scene, k);
}

void SceneSpaces::assign(const WholeRobotScene& scene, int cameras) {
  posed_.clear();
  for (int k = 0; k < cameras; ++k) posed_.push_back({&spaces_[k], scene.views[k].X_BC, 0});
  hidden_.assign(posed_);
}

void MeshMethod::ask(const SceneSpaces& spaces, const RobotPose& pose, const MeshRequest& request) {
  distances_.clear();
  ask_on(spaces, pose, request);
}

void MeshMethod::ask_on(const SceneSpaces& spaces, const RobotPose& pose,
                        const MeshRequest& request) {
  mesh_distances(*robot_, pose, spaces.hidden(), request, workspace_, distances_);
}

}  // namespace berth::lab
