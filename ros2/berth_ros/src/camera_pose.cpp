#include "camera_pose.hpp"

#include <tf2_eigen/tf2_eigen.hpp>

namespace berth_ros {
namespace {

/// TF's tree may be deep, and for a moment have a loop.
constexpr int kMostFrames = 100;

std::string link_above(const tf2_ros::Buffer& tf, const berth::RobotModel& model,
                       const std::string& optical_frame) {
  std::string frame = optical_frame;
  for (int i = 0; i < kMostFrames; ++i) {
    std::string parent;
    if (!tf._getParent(frame, tf2::TimePointZero, parent)) break;
    if (model.find_link(parent)) return parent;
    frame = parent;
  }
  return model.links.front().name;
}

}  // namespace

std::optional<berth::CameraMount> mount_from_tf(const tf2_ros::Buffer& tf,
                                                const berth::RobotModel& model,
                                                const std::string& optical_frame,
                                                const rclcpp::Time& stamp, std::string& why) {
  berth::CameraMount mount;
  mount.parent_link = link_above(tf, model, optical_frame);
  try {
    const auto transform =
        tf.lookupTransform(mount.parent_link, optical_frame, tf2::timeFromSec(stamp.seconds()));
    mount.X_PC = tf2::transformToEigen(transform);
    return mount;
  } catch (const tf2::TransformException& error) {
    why = "no transform from " + mount.parent_link + " to " + optical_frame + ": " + error.what();
    return std::nullopt;
  }
}

bool is_same_mount(const berth::CameraMount& a, const berth::CameraMount& b) {
  if (a.parent_link != b.parent_link) return false;
  const berth::Pose between = a.X_PC.inverse() * b.X_PC;
  return between.translation().norm() <= 1e-4 &&
         Eigen::AngleAxisd(between.linear()).angle() <= 1e-4;
}

}  // namespace berth_ros
