#include "sim/drawn_calibration_data.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/sensor_model.hpp"

namespace berth::sim {
namespace {

constexpr int kMostPlaces = 200;
/// Of a robot that carries its camera: in many, the camera sees nothing of it.
constexpr int kMostDrives = 30;
/// Of the image, in each pose.
constexpr double kLeastSeenShare = 0.02;
/// From one pose to the next, and how often the joints are told.
constexpr double kLeg_s = 1.5;
constexpr double kSample_s = 0.01;

using Joints = std::vector<double>;

/// Half the way of each joint's range at most from one pose to the next.
std::vector<Joints> draw_waypoints(Random& random, const RobotModel& model, int count) {
  std::vector<Joints> waypoints;
  for (int i = 0; i < count; ++i) {
    Joints next = draw_joints(random, model).position;
    if (!waypoints.empty()) {
      for (std::size_t j = 0; j < next.size(); ++j) {
        next[j] = waypoints.back()[j] + std::clamp(next[j] - waypoints.back()[j], -1.0, 1.0);
      }
    }
    waypoints.push_back(next);
  }
  return waypoints;
}

Joints joints_at(const std::vector<Joints>& waypoints, double time_s) {
  const double leg = std::clamp(time_s / kLeg_s, 0.0, static_cast<double>(waypoints.size() - 1));
  const auto from = std::min(static_cast<std::size_t>(leg), waypoints.size() - 2);
  const double part = 0.5 - 0.5 * std::cos(std::numbers::pi * (leg - static_cast<double>(from)));
  Joints joints;
  for (std::size_t j = 0; j < waypoints[0].size(); ++j) {
    joints.push_back(std::lerp(waypoints[from][j], waypoints[from + 1][j], part));
  }
  return joints;
}

RobotPose pose_at(const RobotModel& model, const Joints& joints) {
  RobotPose pose;
  forward_kinematics(model, joints, pose);
  return pose;
}

/// The robot is seen in each pose.
void place_camera(Random& random, const RobotModel& model, const std::vector<Joints>& exposures,
                  const DrawnCalibrationSettings& settings, CalibrationCamera& camera) {
  const RobotExtent robot = extent_of(model, pose_at(model, exposures[0]));
  for (int i = 0; i < kMostPlaces; ++i) {
    camera.camera = draw_camera(random, settings.width_px, settings.height_px);
    camera.X_PC = draw_camera_pose(random, robot);
    const bool is_seen = std::all_of(exposures.begin(), exposures.end(), [&](const Joints& joints) {
      const EmbreeRenderer rays(model, pose_at(model, joints), camera.X_PC, camera.camera);
      return robot_share(cast_image(rays, camera.camera)) > kLeastSeenShare;
    });
    if (is_seen) return;
  }
  throw std::runtime_error("no camera sees robot " + model.name);
}

std::vector<RobotPose> poses_at(const RobotModel& model, const std::vector<Joints>& exposures) {
  std::vector<RobotPose> poses;
  for (const Joints& joints : exposures) poses.push_back(pose_at(model, joints));
  return poses;
}

/// Where the robot goes, and when its images are taken.
struct Drive {
  std::vector<Joints> waypoints;
  std::vector<double> stamps_s;
  std::vector<Joints> exposures;
};

/// With a camera, which is set, that sees the robot on the way.
Drive draw_drive(Random& random, const RobotModel& model, const DrawnCalibrationSettings& settings,
                 CalibrationCamera& camera) {
  for (int i = 0; i < kMostDrives; ++i) {
    Drive drive{draw_waypoints(random, model, settings.poses + 1), {}, {}};
    for (int k = 0; k < settings.poses; ++k) {
      drive.stamps_s.push_back(kLeg_s * (k + (settings.moves ? random(0.3, 0.7) : 0)));
      drive.exposures.push_back(
          joints_at(drive.waypoints, drive.stamps_s.back() + settings.errors.clock_offset_s));
    }
    if (settings.mount == DrawnMount::root) {
      place_camera(random, model, drive.exposures, settings, camera);
      return drive;
    }
    if (place_hand_camera(random, model, poses_at(model, drive.exposures), settings.mount,
                          settings.width_px, settings.height_px, camera)) {
      return drive;
    }
  }
  throw std::runtime_error("no camera on robot " + model.name + " sees it");
}

/// Farther from the robot's middle than the robot reaches, so that it never meets them.
void add_things(Random& random, const RobotExtent& robot, const Pose& X_BC,
                std::vector<DrawnObstacle>& obstacles) {
  for (int i = 0; i < 6; ++i) {
    const double radius_m = robot.radius_m * random(0.1, 0.4);
    const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
    const Eigen::Vector3d p_B_m = robot.centre_B_m + (1.3 * robot.radius_m + radius_m) * direction;
    // Nothing stands between camera and robot.
    if (direction.dot((X_BC.translation() - robot.centre_B_m).normalized()) > 0.2) continue;
    Pose X_BO(draw_rotation(random));
    X_BO.translation() = p_B_m;
    obstacles.push_back({draw_obstacle(random, radius_m), X_BO});
  }
}

DepthImage sense(const RobotModel& model, const Joints& joints,
                 const std::vector<DrawnObstacle>& obstacles, const CalibrationCamera& camera,
                 const DrawnCalibrationSettings& settings, std::uint32_t seed) {
  const RobotPose pose = pose_at(model, joints);
  const Pose X_BC = pose.X_BL[camera.parent] * camera.X_PC;
  const EmbreeRenderer rays(model, pose, X_BC, camera.camera);
  DepthImage depth_m = cast_image(rays, camera.camera).depth_m;
  const DepthImage room_m = cast_obstacles(obstacles, camera.camera, X_BC);
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    float& z_m = depth_m.pixels()[i];
    const float behind_m = room_m.pixels()[i];
    if (std::isnan(z_m) || behind_m < z_m) z_m = behind_m;
    z_m *= static_cast<float>(1 + settings.errors.depth_share);
  }
  if (!settings.has_sensor_errors) return depth_m;
  add_errors(kKinectErrors, seed, depth_m);
  return depth_m;
}

/// All that the robot and the camera that it carries reach in these poses.
RobotExtent reach_of(const RobotModel& model, const std::vector<RobotPose>& poses,
                     const CalibrationCamera& camera) {
  RobotExtent reach = extent_of(model, poses[0]);
  for (const RobotPose& pose : poses) {
    const RobotExtent robot = extent_of(model, pose);
    const Eigen::Vector3d p_B_m = pose.X_BL[camera.parent] * camera.X_PC.translation();
    reach.radius_m = std::max({reach.radius_m, (p_B_m - reach.centre_B_m).norm(),
                               (robot.centre_B_m - reach.centre_B_m).norm() + robot.radius_m});
    reach.lowest_z_m =
        std::min({reach.lowest_z_m, robot.lowest_z_m, p_B_m.z() - kLeastCameraClearance_m});
  }
  return reach;
}

/// Which joints no image can tell: one that moves all that is seen alike, and one at the end whose
/// link looks alike from all sides, as a rule.
bool is_observable(const RobotModel& model, std::size_t joint) {
  return joint > 0 && joint + 1 < model.joints.size() &&
         model.joints[joint].type != JointType::prismatic;
}

}  // namespace

DrawnCalibrationData draw_calibration_data(const RobotModel& model,
                                           std::shared_ptr<const LinkMeshes> meshes,
                                           const DrawnCalibrationSettings& settings,
                                           std::uint32_t seed) {
  Random random(seed);
  DrawnCalibrationData drawn;
  drawn.camera = std::make_unique<CalibrationCamera>();
  CalibrationCamera& camera = *drawn.camera;
  camera.name = "camera";
  camera.has_stamps = settings.moves;
  const Drive drive = draw_drive(random, model, settings, camera);
  const auto& [waypoints, stamps_s, exposures] = drive;
  drawn.X_PC_true = camera.X_PC;

  const std::vector<RobotPose> poses = poses_at(model, exposures);
  const Pose X_BC = poses[0].X_BL[camera.parent] * camera.X_PC;
  const RobotExtent reach = settings.mount == DrawnMount::root ? extent_of(model, poses[0])
                                                               : reach_of(model, poses, camera);
  std::vector<DrawnObstacle> obstacles;
  add_room(random, reach, X_BC, obstacles);
  add_things(random, reach, X_BC, obstacles);

  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const double sign = random.whole(0, 1) == 0 ? -1 : 1;
    drawn.joint_shift.push_back(is_observable(model, j) ? sign * settings.errors.joint_zero : 0);
  }
  const auto believed = [&](double time_s) {
    Joints joints = joints_at(waypoints, time_s);
    for (std::size_t j = 0; j < joints.size(); ++j) joints[j] -= drawn.joint_shift[j];
    return joints;
  };
  for (int i = 0; i < settings.poses; ++i) {
    camera.frames.push_back({i,
                             sense(model, exposures[i], obstacles, camera, settings,
                                   seed + 10 * static_cast<std::uint32_t>(i)),
                             {stamps_s[i], believed(stamps_s[i])}});
    drawn.joints_at_exposure.push_back(believed(stamps_s[i] + settings.errors.clock_offset_s));
  }
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  std::vector<JointTrajectory::Sample> samples;
  for (double t_s = -0.5; t_s < kLeg_s * settings.poses + 0.5; t_s += kSample_s) {
    samples.push_back({t_s, believed(t_s)});
  }
  drawn.joints = std::make_unique<JointTrajectory>(model, "drawn", names, samples);
  drawn.calibration_data = {&model, std::move(meshes), drawn.joints.get(), {drawn.camera.get()}};
  return drawn;
}

}  // namespace berth::sim
