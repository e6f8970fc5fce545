#include "berth/pipeline/robot.hpp"

namespace berth {

Robot::Robot(RobotModel model, EvaluationSettings settings)
    : model_(std::move(model)), settings_(std::move(settings)), meshes_(build_link_meshes(model_)) {
  validate(settings_.distance);
  validate(settings_.time);
  const bool has_mesh = settings_.method == Method::mesh;
  if (has_mesh) patches_ = build_robot_patches(model_);
  if (settings_.visibility || has_mesh) sample_points_ = berth::sample_points(model_);
}

}  // namespace berth
