#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "berth/sensor/settings.hpp"
#include "berth/space/settings.hpp"
#include "lab/trust/trial.hpp"

namespace berth::lab {

/// Cameras that are drawn; the estimates take the first one, the first two, and so on.
inline constexpr int kMostTrialCameras = 4;

/// Errors of several cameras' images, and what is done with them.
struct WholeRobotCondition {
  std::string name;
  /// The ideal one goes with clean images alone.
  MeasuredFilter filter = MeasuredFilter::ideal;
  SelfFilterSettings self_filter = {};
  SpaceSettings space = {};
  /// SensorSettings::phantom_radius_m, with berth's self filter.
  double phantom_radius_m = SensorSettings{}.phantom_radius_m;
  sim::SensorErrors image = {};
  /// Of each camera by itself.
  PoseErrors pose = {};
  /// Each image but the first one is up to this old. Robot and obstacles have moved since.
  double most_age_s = 0;
  /// Whether the method is told how old.
  bool knows_age = true;
};
std::vector<WholeRobotCondition> whole_robot_conditions();

/// What the method `mesh` says of a link; infinite where it says that nothing is in range.
struct WholeRobotEstimate {
  double nearest_m;
  double reading_m;
};

/// The truth of one link.
struct WholeRobotTruth {
  /// From the whole link to all sides of all obstacles.
  double distance_m = 0;
  /// [k] says how the obstacle's nearest point shows in the clean images of the first k + 1
  /// cameras: covered in at least one, else behind the robot in at least one, else outside of all.
  std::array<sim::ObstacleSight, kMostTrialCameras> sight;
};

/// One scene. Inner indices are links, [i] that with the id i + 1.
struct WholeRobotTrial {
  const TrialRobot* robot = nullptr;
  std::uint32_t seed = 0;
  std::vector<WholeRobotTruth> truth;
  struct UnderCondition {
    /// [k] with k + 1 cameras.
    std::vector<std::vector<WholeRobotEstimate>> mesh;
    /// `exact` with the first camera.
    std::vector<Estimate> exact;
  };
  std::vector<UnderCondition> under;
};

/// With three cameras, clean images and an ideal filter, `nearest` is above the true distance of
/// the whole link by no more than this where the obstacle is in an image. Nothing proves it: it is
/// twice the most of 14 420 links of a thousand scenes with eleven robots (24.6 mm, seed 524).
inline constexpr double kMaxWholeRobotOverestimate_m = 0.05;

/// How fast obstacles move where images are out of step; floor and wall stand still. Joints move at
/// up to kTrialJointSpeed_per_s.
inline constexpr double kTrialObstacleSpeed_m_s = 1.6;

/// Draws the scene and measures it under every condition. Depends on its arguments alone.
WholeRobotTrial run_whole_robot_trial(const TrialRobot& robot,
                                      const sim::DrawnSceneSettings& settings, std::uint32_t seed,
                                      const std::vector<WholeRobotCondition>& conditions);

}  // namespace berth::lab
