#include "tests/image_distance/visibility/small_world.hpp"

#include <algorithm>

#include "berth/render/robot_renderer.hpp"

namespace berth {

SmallWorld::SmallWorld(RobotModel robot_model, const std::vector<Pose>& X_CL,
                       const Camera& any_camera)
    : model(std::move(robot_model)),
      camera(any_camera),
      pose(pose_seen_at(Pose::Identity(), X_CL)),
      asked_pose(pose) {
  // As simple as it can be, so that a test knows each pixel's fate.
  settings.padding_m = settings.flying_patch_radius_m = 0;
  RobotRenderer(build_link_meshes(model), camera).render(pose, Pose::Identity(), robot);
  sensor_depth_m = robot.depth_m;
  for (float& depth_m : sensor_depth_m.pixels()) depth_m = std::isnan(depth_m) ? kWall_m : depth_m;
}

void SmallWorld::put(const PixelRect& rect, float depth_m) {
  const PixelRect inside = clip(rect, camera.width_px, camera.height_px);
  for (int v = inside.v_begin; v < inside.v_end; ++v) {
    std::fill(sensor_depth_m.row(v) + inside.u_begin, sensor_depth_m.row(v) + inside.u_end,
              depth_m);
  }
}

void SmallWorld::move_asked(const std::vector<Pose>& X_CL) {
  asked_pose = pose_seen_at(Pose::Identity(), X_CL);
}

std::vector<LinkVisibility> SmallWorld::find(const LinkDistance& answer, double range_m) {
  SelfFilterWorkspace filter;
  self_filter(camera, sensor_depth_m, robot, settings, filter, obstacles);
  RobotImage asked_robot;
  RobotRenderer(build_link_meshes(model), camera).render(asked_pose, Pose::Identity(), asked_robot);
  LinkDistances distances;
  distances.links.assign(model.link_count(), answer);
  VisibilityWorkspace workspace;
  std::vector<LinkVisibility> out;
  find_visibility(model, sample_points(model), frame(), {asked_pose, Pose::Identity(), asked_robot},
                  distances, range_m, workspace, out);
  return out;
}

LinkVisibility SmallWorld::around(const Eigen::Vector3f& robot_point_C_m, float radius_m) {
  LinkDistance answer;
  answer.status = LinkStatus::ok;
  answer.distance_m = radius_m;
  answer.robot_point_C_m = robot_point_C_m;
  return find(answer).front();
}

}  // namespace berth
