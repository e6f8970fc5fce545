#include "lab/trust/scene_images.hpp"
#include "berth/render/robot_renderer.hpp"

#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

/// The image of these errors, made if it is not there yet.
template <class Errors, class Image, class Make>
const Image& find_or_make(std::list<std::pair<Errors, Image>>& images, const Errors& errors,
                          Make make) {
  for (const auto& [key, image] : images) {
    if (key == errors) return image;
  }
  return images.emplace_back(errors, make()).second;
}

}  // namespace

const DepthImage& SceneImages::sensed(const sim::SensorErrors& errors) {
  return find_or_make(sensed_, errors, [&] { return sense(errors); });
}

const RobotImage& SceneImages::believed(const PoseErrors& errors) {
  return find_or_make(believed_, errors, [&] { return render(errors); });
}

Pose SceneImages::believed_X_BC(const PoseErrors& errors) const {
  return sim::miscalibrated(scene_.X_BC, errors.offset_m, errors.angle_rad, seed_ + 4);
}

DepthImage SceneImages::sense(const sim::SensorErrors& errors) const {
  DepthImage depth_m = scene_.depth_m;
  sim::add_errors(errors, seed_, depth_m);
  return depth_m;
}

RobotImage SceneImages::render(const PoseErrors& errors) const {
  const JointState joints =
      sim::delayed(model_, scene_.joints, errors.delay_s, kTrialJointSpeed_per_s, seed_ + 5);
  RobotPose pose;
  forward_kinematics(model_, joints.position, pose);
  RobotImage image;
  RobotRenderer(meshes_, scene_.camera).render(pose, believed_X_BC(errors), image);
  return image;
}

}  // namespace berth::lab
