#include <numbers>

#include "berth/render/link_meshes.hpp"
#include "berth/render/robot_renderer.hpp"
#include "lab/stream/film.hpp"
#include "sim/drawn_scene.hpp"

namespace berth::lab {
namespace {

constexpr double kLength_s = 4;
constexpr double kImages_hz = 10;
constexpr double kSamples_hz = 100;
/// Three times as fast, the fastest joints turn by 0.05 rad between two images of a camera.
constexpr double kSway_rad = 0.1;
constexpr double kMostSpeed_rad_s = 0.5;
/// Neighbouring cameras stand as far apart as all around the robot allows, more or less.
constexpr double kTurnSpread_rad = 0.5;

JointTrajectory sway(const RobotModel& model, const JointState& about, sim::Random& random) {
  std::vector<std::string> names;
  std::vector<double> phases, speeds;
  for (const MovableJoint& joint : model.joints) {
    names.push_back(joint.name);
    phases.push_back(random(0, 2 * std::numbers::pi));
    speeds.push_back(random(0.5, 1) * kMostSpeed_rad_s / kSway_rad);
  }
  std::vector<JointTrajectory::Sample> samples;
  for (int i = 0; i <= kLength_s * kSamples_hz; ++i) {
    JointTrajectory::Sample& sample = samples.emplace_back();
    sample.time_s = i / kSamples_hz;
    sample.positions = about.position;
    for (std::size_t k = 0; k < names.size(); ++k) {
      sample.positions[k] += kSway_rad * std::sin(speeds[k] * sample.time_s + phases[k]);
    }
  }
  return {model, "a drawn room", names, samples};
}

/// Around the upright through the robot's middle.
Pose turned_about(const Eigen::Vector3d& middle_B_m, double angle_rad, const Pose& X_BC) {
  const Eigen::Translation3d to(middle_B_m);
  return to * Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()) * to.inverse() * X_BC;
}

FilmedCamera film_from(const Film& film, const sim::DrawnScene& drawn, const Pose& X_BC,
                       const CameraSettings& settings, double first_s) {
  FilmedCamera camera;
  camera.mounted = std::make_shared<const MountedCamera>(
      film.robot, CameraMount{drawn.camera, film.robot->model().links.front().name, X_BC},
      settings);
  const DepthImage room_m = sim::cast_obstacles(drawn.obstacles, drawn.camera, X_BC);
  RobotRenderer renderer(film.robot->meshes(), drawn.camera);
  RobotImage robot;
  RobotPose pose;
  JointState joints;
  for (double at_s = first_s; at_s < kLength_s; at_s += 1 / kImages_hz) {
    (void)film.joints->at(at_s, kAnyGap, joints);
    forward_kinematics(film.robot->model(), joints.position, pose);
    renderer.render(pose, X_BC, robot);
    camera.stamps_s.push_back(at_s);
    camera.depth_m.push_back(drawn_over(robot.depth_m, room_m));
  }
  return camera;
}

}  // namespace

DepthImage drawn_over(const DepthImage& robot_m, DepthImage depth_m) {
  for (std::size_t i = 0; i < depth_m.pixels().size(); ++i) {
    const float at_m = robot_m.pixels()[i];
    if (!std::isnan(at_m) && !(depth_m.pixels()[i] < at_m)) depth_m.pixels()[i] = at_m;
  }
  return depth_m;
}

Film film_of_room(const std::shared_ptr<const Robot>& robot, const CameraSettings& settings,
                  const RoomSettings& room, std::size_t cameras) {
  const RobotModel& model = robot->model();
  const sim::DrawnScene drawn =
      sim::draw_scene(model, sim::build_link_trees(model),
                      {.width_px = room.width_px, .height_px = room.height_px}, room.seed);
  sim::Random random(room.seed + 1000);
  Film film{robot, std::make_shared<const JointTrajectory>(sway(model, drawn.joints, random)), {}};
  const Eigen::Vector3d middle_B_m = sim::extent_of(model, drawn.pose).centre_B_m;
  for (std::size_t k = 0; k < cameras; ++k) {
    const double spread_rad = k == 0 ? 0 : random(-kTurnSpread_rad, kTurnSpread_rad);
    const double part = static_cast<double>(k) / static_cast<double>(cameras);
    const Pose X_BC =
        turned_about(middle_B_m, 2 * std::numbers::pi * part + spread_rad, drawn.X_BC);
    film.cameras.push_back(film_from(film, drawn, X_BC, settings, part / kImages_hz));
  }
  return film;
}

}  // namespace berth::lab
