#include "berth/calibration/drawn_image_filter.hpp"

namespace berth {

const ObstacleImage& DrawnImageFilter::run(const FilteredCamera& camera, DepthView depth_m) {
  SelfFilterSettings settings = *camera.self_filter;
  settings.robot_region_scale = 0;
  self_filter(*camera.camera, depth_m, *camera.robot, settings, workspace_, out_);
  if (camera.soft) drop_soft(*camera.camera, *camera.soft, out_);
  SensorSettings sensor = *camera.sensor;
  sensor.background_frames = 0;
  apply_sensor_rules(*camera.camera, depth_m, *camera.robot, {}, sensor, sensor_workspace_, out_);
  drop_phantoms(*camera.camera, depth_m, sensor.phantom_radius_m, phantoms_, out_);
  return out_;
}

}  // namespace berth
