#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "berth/render/robot_renderer.hpp"
#include "berth/types/link_distance.hpp"
#include "condition.hpp"
#include "testing/true_distance.hpp"

namespace berth {

/// A robot with all that is built once.
struct TrialRobot {
  std::string name;
  RobotModel model;
  std::vector<testing::MeshTree> link_trees;
  std::shared_ptr<const LinkMeshes> meshes;
};
TrialRobot make_trial_robot(std::string name, RobotModel model);

/// What berth says of a link.
struct Estimate {
  LinkStatus status = LinkStatus::not_visible;
  /// NaN unless the status is ok.
  double distance_m = 0;
};

/// One scene: its truth, and an estimate for each condition and link. [i] is the link with the id
/// i + 1.
struct Trial {
  const TrialRobot* robot = nullptr;
  std::uint32_t seed = 0;
  Camera camera;
  std::vector<testing::TrueDistance> truth;
  std::vector<std::vector<Estimate>> estimates;
};

/// Distances are asked for up to here.
inline constexpr double kTrialRange_m = 1.0;
/// Joints move at random at up to this.
inline constexpr double kTrialJointSpeed_per_s = 1.0;

/// Draws the scene and measures it under every condition. Depends on its arguments alone.
Trial run_trial(const TrialRobot& robot, const testing::DrawnSceneSettings& settings,
                std::uint32_t seed, const std::vector<Condition>& conditions);

/// One condition's estimates on a scene that is there.
std::vector<Estimate> estimate(const TrialRobot& robot, const testing::DrawnScene& scene,
                               const Condition& condition, std::uint32_t seed);

}  // namespace berth
