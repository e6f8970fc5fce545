#include "berth/pipeline/rig.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

#include "berth/robot/robot_region.hpp"

namespace berth {
namespace {

std::size_t find_parent(const RobotModel& model, const std::string& name) {
  if (const auto index = model.find_link(name)) return *index;
  std::vector<std::string> known;
  for (const Link& link : model.links) known.push_back(link.name);
  throw std::invalid_argument(
      fmt::format("camera: parent link \"{}\" is not in robot \"{}\"; expected one of {}", name,
                  model.name, fmt::join(known, ", ")));
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

}  // namespace

Rig::Rig(RobotModel model, CameraMount mount, RigSettings settings)
    : model_(std::move(model)),
      mount_(std::move(mount)),
      settings_(std::move(settings)),
      parent_(find_parent(model_, mount_.parent_link)),
      meshes_(build_link_meshes(model_)) {
  if (!mount_.X_PC.matrix().allFinite()) {
    throw std::invalid_argument("camera: the pose X_PC is not set; expected finite numbers");
  }
  if (!settings_.link_padding_m.empty()) {
    settings_.self_filter.link_padding_m = padding_by_id(model_, settings_.link_padding_m);
  }
  validate(settings_.self_filter);
  validate(settings_.sensor);
  if (settings_.sensor.has_background()) {
    require_fixed_camera(model_, parent_, settings_.sensor.background_frames);
  }
  validate(settings_.distance);
  validate(settings_.time);
  if (settings_.visibility) sample_points_ = berth::sample_points(model_);
  const double region_scale = settings_.self_filter.robot_region_scale;
  if (region_scale > 0) region_meshes_ = build_link_meshes(robot_region(model_, region_scale));
}

}  // namespace berth
