#include "berth/pipeline/environment_back.hpp"

#include "berth/space/serial_number.hpp"

namespace berth {

EnvironmentBack::EnvironmentBack(const RobotModel& model, const Camera& camera)
    : still_(model, DrawnLinks::environment) {
  if (still_.is_empty()) return;
  renderer_.emplace(build_link_meshes(model, DrawnLinks::environment), camera);
}

EnvironmentSurfaces EnvironmentBack::at(const RobotPose& pose, const Pose& X_BC) {
  if (renderer_ && !still_.stand_at(pose, X_BC)) render(pose, X_BC);
  return {front_.depth_m, back_.depth_m, serial_number_};
}

void EnvironmentBack::render(const RobotPose& pose, const Pose& X_BC) {
  renderer_->render(pose, X_BC, front_);
  renderer_->render_behind(pose, X_BC, front_, back_);
  still_.drawn_at(pose, X_BC);
  serial_number_ = mesh::next_serial_number();
  auto& back_m = back_.depth_m.pixels();
  for (std::size_t i = 0; i < back_m.size(); ++i) {
    if (back_.link_id.pixels()[i] != kNoLink) continue;
    back_m[i] = front_.depth_m.pixels()[i];
    back_.link_id.pixels()[i] = front_.link_id.pixels()[i];
  }
}

}  // namespace berth
