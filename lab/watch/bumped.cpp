#include "lab/watch/bumped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "berth/render/robot_renderer.hpp"
#include "berth/watch/frame_displacement.hpp"
#include "berth/watch/pose_watch.hpp"
#include "lab/watch/hidden_image.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

/// Never an alarm: reports T alone.
constexpr WatchSettings kTellT{.max_seen_through = 1};

std::vector<Eigen::Vector3d> directions() {
  std::vector<Eigen::Vector3d> all;
  for (const int sign : {-1, 1}) {
    for (int axis = 0; axis < 3; ++axis) all.push_back(sign * Eigen::Vector3d::Unit(axis));
    for (int corner = 0; corner < 4; ++corner) {
      all.push_back(Eigen::Vector3d(sign, corner & 1 ? 1 : -1, corner & 2 ? 1 : -1).normalized());
    }
  }
  return all;
}

/// Draws the robot where a camera believes that it is.
class Believed {
 public:
  explicit Believed(const OpenCamera& camera)
      : mounted_(*camera.mounted), renderer_(mounted_.robot()->meshes(), mounted_.camera()) {}

  const RobotImage& robot(const JointState& joints, const Pose& X_CC = Pose::Identity()) {
    forward_kinematics(mounted_.robot()->model(), joints.position, pose_);
    renderer_.render(pose_, mounted_.camera_pose(pose_) * X_CC, image_);
    return image_;
  }

 private:
  const MountedCamera& mounted_;
  RobotRenderer renderer_;
  RobotPose pose_;
  RobotImage image_;
};

std::vector<DepthImage> noisy_images(const DepthImage& depth_m, std::uint32_t seed) {
  std::vector<DepthImage> images(kFramesPerSecond, depth_m);
  for (DepthImage& image : images) {
    sim::add_noise(0.0015, ++seed, image);
    sim::drop_out(0.01, seed, image);
  }
  return images;
}

/// One second of images, the robot where it is believed to be in them, and the joints.
struct Second {
  std::vector<DepthImage> images;
  const RobotImage& robot;
  const JointState& joints;
  /// The pose of the camera as it is believed to be, in the frame of the one that took the images.
  Pose X_CC = Pose::Identity();
};

template <class Take>
void each_bumped_second(const OpenCamera& camera, const Bump& bump, int nth, const Take& take) {
  Believed believed(camera);
  for (std::size_t k = 0; k < camera.source.depth.size(); k += static_cast<std::size_t>(nth)) {
    const auto images = noisy_images(camera.read_depth(k), static_cast<std::uint32_t>(1000 * k));
    for (const Eigen::Vector3d& direction : directions()) {
      const Pose X_CC = Eigen::Translation3d(bump.offset_m * direction) *
                        Pose(Eigen::AngleAxisd(bump.angle_rad, direction));
      take(
          Second{images, believed.robot(camera.at_exposure[k], X_CC), camera.at_exposure[k], X_CC});
    }
  }
}

template <class Take>
void each_hidden_second(const OpenCamera& camera, int draws, const Take& take) {
  for (int draw = 0; draw < draws; ++draw) {
    const auto seed = static_cast<std::uint32_t>(draw);
    const HiddenImage hidden = hidden_image(camera, seed);
    take(Second{noisy_images(hidden.depth_m, 100 * seed), hidden.robot,
                camera.at_exposure[hidden.frame]});
  }
}

SeenThroughs seen_throughs(const Second& second) {
  PoseWatch watch(kTellT);
  SeenThroughs told;
  for (const DepthImage& depth_m : second.images) {
    told.push_back(watch.look(depth_m, second.robot, {}).seen_through);
  }
  return told;
}

FrameDisplacement displacement_of(const OpenCamera& camera, const Pose& X_CC) {
  const RobotModel& model = camera.mounted->robot()->model();
  const CameraMount& mount = camera.mounted->mount();
  return {model,
          camera.mounted->robot()->meshes(),
          mount.camera,
          *model.find_link(mount.parent_link),
          mount.X_PC * X_CC,
          0};
}

/// Whether T or D raises an alarm within the second.
bool is_watch_alarm(const OpenCamera& camera, const Second& second, const WatchSettings& rule) {
  const FrameDisplacement displacement = displacement_of(camera, second.X_CC);
  PoseWatch watch(rule, [&](DepthView depth_m, const JointState& joints, const Pose&,
                            const std::stop_token& stop) {
    return displacement.measure(depth_m, joints, stop);
  });
  JointState joints = second.joints;
  for (std::size_t i = 0; i < second.images.size(); ++i) {
    joints.stamp_s = static_cast<double>(i) / kFramesPerSecond;
    watch.look(second.images[i], second.robot, joints);
    if (watch.wait().has_moved) return true;
  }
  return false;
}

}  // namespace

SeenThroughs own_frames(const OpenCamera& camera) {
  Believed believed(camera);
  PoseWatch watch(kTellT);
  SeenThroughs told;
  for (std::size_t k = 0; k < camera.source.depth.size(); ++k) {
    const RobotImage& robot = believed.robot(camera.at_exposure[k]);
    told.push_back(watch.look(camera.read_depth(k), robot, camera.at_exposure[k]).seen_through);
  }
  return told;
}

Displacements own_displacements(const OpenCamera& camera, int nth) {
  const FrameDisplacement displacement = displacement_of(camera, Pose::Identity());
  Displacements told_m;
  for (std::size_t k = 0; k < camera.source.depth.size(); k += static_cast<std::size_t>(nth)) {
    told_m.push_back(displacement.measure(camera.read_depth(k), camera.at_exposure[k])
                         .value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return told_m;
}

std::vector<SeenThroughs> bumped_seconds(const OpenCamera& camera, const Bump& bump, int nth) {
  std::vector<SeenThroughs> seconds;
  each_bumped_second(camera, bump, nth,
                     [&](const Second& second) { seconds.push_back(seen_throughs(second)); });
  return seconds;
}

std::vector<SeenThroughs> hidden_seconds(const OpenCamera& camera, int draws) {
  std::vector<SeenThroughs> seconds;
  each_hidden_second(camera, draws,
                     [&](const Second& second) { seconds.push_back(seen_throughs(second)); });
  return seconds;
}

AlarmCount bumped_alarms(const OpenCamera& camera, const Bump& bump, int nth,
                         const WatchSettings& rule) {
  AlarmCount count;
  each_bumped_second(camera, bump, nth, [&](const Second& second) {
    count.alarms += is_watch_alarm(camera, second, rule);
    ++count.seconds;
  });
  return count;
}

AlarmCount hidden_alarms(const OpenCamera& camera, int draws, const WatchSettings& rule) {
  AlarmCount count;
  each_hidden_second(camera, draws, [&](const Second& second) {
    count.alarms += is_watch_alarm(camera, second, rule);
    ++count.seconds;
  });
  return count;
}

bool is_alarm(const SeenThroughs& frames, const WatchSettings& rule) {
  Agreement moved(rule.agreeing_frames, rule.frames);
  return std::any_of(frames.begin(), frames.end(), [&](double seen_through) {
    if (!std::isnan(seen_through)) moved.add(seen_through > rule.max_seen_through);
    return moved.state();
  });
}

double alarm_share(const std::vector<SeenThroughs>& seconds, const WatchSettings& rule) {
  const auto alarms =
      std::count_if(seconds.begin(), seconds.end(),
                    [&](const SeenThroughs& frames) { return is_alarm(frames, rule); });
  return static_cast<double>(alarms) / static_cast<double>(seconds.size());
}

}  // namespace berth::lab
