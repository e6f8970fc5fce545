#include "berth/pipeline/mounted_camera.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "berth/render/robot_renderer.hpp"
#include "berth/robot/surface.hpp"

namespace berth {
namespace {

std::size_t find_parent(const RobotModel& model, const CameraMount& mount) {
  if (const auto index = model.find_link(mount.parent_link)) return *index;
  std::vector<std::string> known;
  for (const Link& link : model.links) known.push_back(link.name);
  throw std::invalid_argument(
      fmt::format("camera {}: parent link \"{}\" is not in robot \"{}\"; expected one of {}",
                  mount.name, mount.parent_link, model.name, fmt::join(known, ", ")));
}

/// The settings' names of links, as the self filter's list by id.
std::vector<double> padding_by_id(const RobotModel& model,
                                  const std::map<std::string, double>& by_name) {
  std::vector<double> by_id(by_name.empty() ? 0 : model.link_count(),
                            std::numeric_limits<double>::quiet_NaN());
  for (const auto& [name, padding_m] : by_name) {
    const auto index = model.find_link(name);
    if (!index || model.links[*index].role != LinkRole::evaluated) {
      throw std::invalid_argument(
          fmt::format("self_filter.link_padding_m: \"{}\" is no evaluated link of robot \"{}\"; "
                      "expected one of {}",
                      name, model.name, fmt::join(model.evaluated_link_names(), ", ")));
    }
    if (!(padding_m >= 0)) {
      throw std::invalid_argument(fmt::format(
          "self_filter.link_padding_m: {}: {}; expected a number of at least 0", name, padding_m));
    }
    by_id[model.links[*index].id - 1] = padding_m;
  }
  return by_id;
}

/// A background is what one place of the camera sees.
void require_fixed_camera(const RobotModel& model, std::size_t parent, int background_frames) {
  for (std::optional<std::size_t> i = parent; i; i = model.links[*i].parent) {
    const Joint& joint = model.links[*i].joint;
    if (!model.links[*i].parent || joint.type == JointType::fixed) continue;
    throw std::invalid_argument(fmt::format(
        "sensor.background_frames: {}, but the camera's parent link \"{}\" moves with "
        "joint \"{}\"; expected 0, or a camera that is fixed to the root link \"{}\"",
        background_frames, model.links[parent].name, joint.name, model.links.front().name));
  }
}

/// Half the greatest difference from 1 of a rotation's squared singular values that rounding
/// explains: a quaternion with three decimals is off by no more.
constexpr double kRotationTolerance = 2e-3;

void require_pose(const Pose& X_PC) {
  if (!X_PC.matrix().allFinite()) {
    throw std::invalid_argument("camera: the pose X_PC is not set; expected finite numbers");
  }
  const Eigen::Matrix3d R = X_PC.linear();
  const double error = (R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error <= kRotationTolerance && R.determinant() > 0) return;
  throw std::invalid_argument(fmt::format(
      "camera: the pose X_PC has no rotation: its axes have lengths {:.4g}, {:.4g}, {:.4g} and the "
      "determinant is {:.4g}; expected axes of length 1 at right angles, and 1",
      R.col(0).norm(), R.col(1).norm(), R.col(2).norm(), R.determinant()));
}

void require_camera(const Camera& camera) {
  const bool has_focus = camera.fx_px > 0 && camera.fy_px > 0 && std::isfinite(camera.fx_px) &&
                         std::isfinite(camera.fy_px);
  if (camera.width_px > 0 && camera.height_px > 0 && has_focus && std::isfinite(camera.cx_px) &&
      std::isfinite(camera.cy_px)) {
    return;
  }
  throw std::invalid_argument(fmt::format(
      "camera: {} x {} px, focal lengths {} and {}, centre ({}, {}); expected a size and focal "
      "lengths above 0, and finite numbers",
      camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px));
}

}  // namespace

CameraSettings settings_of_real_camera() {
  CameraSettings settings;
  settings.watch = {};
  return settings;
}

MountedCamera::MountedCamera(std::shared_ptr<const Robot> robot, CameraMount mount,
                             CameraSettings settings)
    : robot_(std::move(robot)),
      mount_(std::move(mount)),
      settings_(std::move(settings)),
      parent_(find_parent(robot_->model(), mount_)) {
  const RobotModel& model = robot_->model();
  require_camera(mount_.camera);
  require_pose(mount_.X_PC);
  if (!settings_.link_padding_m.empty()) {
    settings_.self_filter.link_padding_m = padding_by_id(model, settings_.link_padding_m);
  }
  validate(settings_.self_filter);
  validate(settings_.sensor);
  validate(settings_.space);
  validate(settings_.watch);
  if (settings_.sensor.has_background()) {
    require_fixed_camera(model, parent_, settings_.sensor.background_frames);
  }
  const double region_scale = settings_.self_filter.robot_region_scale;
  if (region_scale > 0) region_meshes_ = build_link_meshes(robot_region(model, region_scale));
}

Pose MountedCamera::camera_pose(const RobotPose& pose) const {
  return camera_pose(pose, mount_.X_PC);
}

Pose MountedCamera::camera_pose(const RobotPose& pose, const Pose& X_PC) const {
  return pose.X_BL[parent_] * X_PC;
}

std::shared_ptr<const MountedCamera> with_robot(const MountedCamera& mounted,
                                                std::shared_ptr<const Robot> robot) {
  return std::make_shared<const MountedCamera>(std::move(robot), mounted.mount(),
                                               mounted.settings());
}

}  // namespace berth
