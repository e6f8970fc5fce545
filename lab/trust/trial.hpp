#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "berth/render/robot_renderer.hpp"
#include "berth/types/obstacle_image.hpp"
#include "lab/trust/condition.hpp"
#include "sim/true_distance.hpp"
#include "thesis/link_distance.hpp"

namespace berth::lab {

/// A robot with all that is built once.
struct TrialRobot {
  std::string name;
  RobotModel model;
  std::vector<sim::MeshTree> link_trees;
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
  std::vector<sim::TrueDistance> truth;
  std::vector<std::vector<Estimate>> estimates;
};

/// Distances are asked for up to here.
inline constexpr double kTrialRange_m = 1.0;

/// By the method `exact` within kTrialRange_m, without mean directions.
LinkDistances exact_distances(const Camera& camera, const RobotImage& image, int link_count,
                              const DepthImage& obstacle_depth_m);
std::vector<Estimate> to_estimates(const LinkDistances& distances);
/// With the distance to what a rule dropped, where that is nearer.
std::vector<Estimate> with_rejected(const Camera& camera, const RobotImage& image,
                                    DepthView sensed_m, const ObstacleImage& obstacles,
                                    const LinkDistances& distances);

/// Draws the scene and measures it under every condition. Depends on its arguments alone.
Trial run_trial(const TrialRobot& robot, const sim::DrawnSceneSettings& settings,
                std::uint32_t seed, const std::vector<Condition>& conditions);

/// Of a seed: robots and sizes of images in turn.
sim::DrawnSceneSettings trial_scene(int seed);
const TrialRobot& trial_robot(const std::vector<TrialRobot>& robots, int seed);

/// Those of the seeds from 0 on. Says on standard error how far it has come.
std::vector<Trial> run_trials(const std::vector<TrialRobot>& robots,
                              const std::vector<Condition>& conditions, int scenes);

}  // namespace berth::lab
