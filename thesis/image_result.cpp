#include "thesis/image_result.hpp"

#include "berth/pipeline/mounted_camera.hpp"

namespace berth {

ImageDistanceSettings settings_of(const Robot& robot, const ImageSettings& images) {
  ImageDistanceSettings settings;
  static_cast<DistanceSettings&>(settings) = robot.settings().distance;
  static_cast<ImageSettings&>(settings) = images;
  return settings;
}

bool may_end_early(const DistanceSettings& settings) {
  return settings.tolerance_m.value_or(0) > 0 || settings.deadline_us;
}

ImageResult empty_image_result(const Robot& robot, Method method, const ImageSettings& images) {
  validate(images);
  ImageResult result;
  begin_result(robot, result);
  result.has_visibility = false;
  result.method = method;
  result.has_bounds = may_end_early(robot.settings().distance);
  result.cameras.resize(1);
  return result;
}

bool begin_image_result(const Robot& robot, const Exposure& exposure, const CameraState& state,
                        std::optional<double> joints_stamp_s, TimeStatus joints_status,
                        std::optional<double> now_s, ImageResult& out) {
  const TimeSettings& settings = robot.settings().time;
  withhold(out);
  out.pairs = 0;
  out.pairs_of.assign(out.links.size(), {});
  out.stamp_s = std::numeric_limits<double>::quiet_NaN();
  out.joints_stamp_s = joints_stamp_s.value_or(exposure.stamp_s);
  out.time = joints_stamp_s ? timeliness_of(exposure, *joints_stamp_s, now_s, settings)
                            : timeliness_of(exposure, now_s, settings);
  if (joints_status != TimeStatus::ok) out.time.status = joints_status;
  tell_camera(&exposure, state, out.cameras.front());
  if (out.time.status != TimeStatus::ok) return false;
  out.stamp_s = exposure.stamp_s;
  out.status = is_relied_on(state.status) ? ResultStatus::ok : ResultStatus::degraded;
  return true;
}

void tell_image_distances(const LinkDistances& distances, const Pose& X_BC, ImageResult& out) {
  out.pairs = distances.pairs;
  out.pairs_of.resize(out.links.size());
  for (std::size_t i = 0; i < distances.links.size(); ++i) {
    const LinkDistance& from = distances.links[i];
    LinkResult& link = out.links[i];
    link.status = from.status;
    link.distance_m = from.distance_m;
    link.lower_bound_m = from.lower_bound_m;
    out.pairs_of[i] = {from.robot_pixel, from.robot_pixels};
    link.mean_count = from.mean_count;
    if (!from.has_distance()) continue;
    link.camera = 0;
    link.obstacle_pixel = from.obstacle_pixel;
    link.robot_point_C_m = from.robot_point_C_m;
    link.obstacle_point_C_m = from.obstacle_point_C_m;
    link.robot_point_B_m = (X_BC * from.robot_point_C_m.cast<double>()).cast<float>();
    link.obstacle_point_B_m = (X_BC * from.obstacle_point_C_m.cast<double>()).cast<float>();
    link.mean_direction_C = from.mean_direction_C;
    link.mean_direction_B = (X_BC.linear() * from.mean_direction_C.cast<double>()).cast<float>();
  }
  find_nearest(out);
}

}  // namespace berth
