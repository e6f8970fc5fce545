#include "lab/trust/whole_robot_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "berth/distance/mesh_distances.hpp"
#include "berth/pipeline/robot_drawing.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "berth/sensor/phantoms.hpp"
#include "lab/trust/scene_images.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_views.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

SelfFilterSettings narrow_filter() {
  SelfFilterSettings settings;
  settings.tolerance_m = 0.02;
  settings.padding_m = 0.02;
  return settings;
}

/// [k] for the first k + 1 cameras; the sight that shows most counts.
std::array<sim::ObstacleSight, kMostTrialCameras> sights_of(
    const Eigen::Vector3d& p_B, const std::vector<sim::DrawnView>& views) {
  std::array<sim::ObstacleSight, kMostTrialCameras> sights;
  sim::ObstacleSight best = sim::ObstacleSight::outside;
  for (std::size_t k = 0; k < sights.size(); ++k) {
    const sim::DrawnView& view = views[k];
    const Eigen::Vector3d p_C = view.X_BC.inverse() * p_B;
    best = std::min(best, sim::sight_of(p_C, view.camera, view.obstacles.depth_m));
    sights[k] = best;
  }
  return sights;
}

std::vector<WholeRobotTruth> truth_of(const TrialRobot& robot, const sim::DrawnViews& drawn) {
  const sim::DrawnScene& scene = drawn.scene;
  std::vector<sim::MeshTree> obstacles;
  for (const auto& obstacle : scene.obstacles) {
    obstacles.push_back(sim::build_mesh_tree(obstacle.mesh_O));
  }
  std::vector<WholeRobotTruth> truth;
  for (const std::size_t link : robot.model.evaluated_links) {
    sim::SurfacePair nearest;
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const sim::SurfacePair pair =
          sim::closest_points(robot.link_trees[link], scene.pose.X_BL[link], obstacles[i],
                              scene.obstacles[i].X_BO, nearest.distance_m);
      if (pair.distance_m < nearest.distance_m) nearest = pair;
    }
    truth.push_back({nearest.distance_m, sights_of(nearest.b_m, drawn.views)});
  }
  return truth;
}

/// Where the obstacles were; the first two are floor and wall.
std::vector<sim::DrawnObstacle> moved_back(std::vector<sim::DrawnObstacle> obstacles, double age_s,
                                           std::uint32_t seed) {
  sim::Random random(seed);
  for (std::size_t i = 2; i < obstacles.size(); ++i) {
    const Eigen::Vector3d direction = sim::draw_rotation(random) * Eigen::Vector3d::UnitX();
    obstacles[i].X_BO.translation() -= random(0, kTrialObstacleSpeed_m_s) * age_s * direction;
  }
  return obstacles;
}

/// A camera's image with what belongs to it, as the pipeline gets it.
struct SensedView {
  Camera camera;
  Pose X_BC;
  DepthImage sensed_m;
  RobotImage robot;
  ObstacleImage obstacles;
  /// Whose images the surfaces are.
  std::unique_ptr<EnvironmentBack> environment;
  EnvironmentSurfaces surfaces;
  double age_s = 0;
};

/// Each reading is of what the pixel shows in truth.
void filter_ideally(const ObstacleImage& truth, SensedView& sensed) {
  sensed.obstacles = truth;
  for (std::size_t i = 0; i < truth.fate.pixels().size(); ++i) {
    const float sensed_m = sensed.sensed_m.pixels()[i];
    const bool is_obstacle = truth.fate.pixels()[i] == PixelFate::obstacle;
    sensed.obstacles.depth_m.pixels()[i] = is_obstacle ? sensed_m : kNoDepth;
    if (std::isnan(sensed_m)) sensed.obstacles.fate.pixels()[i] = PixelFate::no_reading;
  }
}

/// One drawn scene under one condition.
class Measured {
 public:
  Measured(const TrialRobot& robot, const sim::DrawnViews& drawn,
           const WholeRobotCondition& condition, std::uint32_t seed)
      : robot_(robot), drawn_(drawn), condition_(condition), seed_(seed) {
    for (std::size_t k = 0; k < drawn.views.size(); ++k) views_.push_back(sense(k));
  }

  WholeRobotTrial::UnderCondition estimates() const {
    WholeRobotTrial::UnderCondition under;
    std::vector<CameraSpace> spaces(views_.size());
    std::vector<PosedSpace> posed;
    for (std::size_t k = 0; k < views_.size(); ++k) {
      const SensedView& view = views_[k];
      build_camera_space(view.camera, view.sensed_m, view.obstacles, view.surfaces,
                         condition_.space, spaces[k]);
      posed.push_back({&spaces[k], view.X_BC, condition_.knows_age ? view.age_s : 0});
      under.mesh.push_back(ask(posed));
    }
    const SensedView& first = views_.front();
    under.exact = to_estimates(exact_distances(first.camera, first.robot, robot_.model.link_count(),
                                               first.obstacles.depth_m));
    return under;
  }

 private:
  /// What the camera saw `age_s` before the truth.
  sim::DrawnView look_back(std::size_t k, double age_s, JointState& joints) const {
    const sim::DrawnView& now = drawn_.views[k];
    joints = sim::delayed(robot_.model, drawn_.scene.joints, age_s, kTrialJointSpeed_per_s,
                          seed_ + static_cast<std::uint32_t>(k));
    RobotPose pose;
    forward_kinematics(robot_.model, joints.position, pose);
    return sim::cast_view(robot_.model, pose, moved_back(drawn_.scene.obstacles, age_s, seed_ + 7),
                          now.camera, now.X_BC);
  }

  SensedView sense(std::size_t k) const {
    const std::uint32_t seed = 16 * seed_ + static_cast<std::uint32_t>(k);
    sim::Random random(seed);
    SensedView sensed;
    sim::DrawnView view = drawn_.views[k];
    sim::DrawnScene scene;
    scene.camera = view.camera;
    scene.X_BC = view.X_BC;
    scene.joints = drawn_.scene.joints;
    if (k > 0 && condition_.most_age_s > 0) {
      sensed.age_s = random(0, condition_.most_age_s);
      view = look_back(k, sensed.age_s, scene.joints);
    }
    scene.depth_m = view.depth_m;
    SceneImages images(robot_.model, robot_.meshes, scene, seed);
    sensed.camera = view.camera;
    sensed.X_BC = images.believed_X_BC(condition_.pose);
    sensed.sensed_m = images.sensed(condition_.image);
    sensed.robot = images.believed(condition_.pose);
    sensed.environment = std::make_unique<EnvironmentBack>(robot_.model, sensed.camera);
    sensed.surfaces = sensed.environment->at(drawn_.scene.pose, sensed.X_BC);
    if (condition_.filter == MeasuredFilter::ideal) {
      filter_ideally(view.obstacles, sensed);
    } else {
      SelfFilterWorkspace workspace;
      self_filter(sensed.camera, sensed.sensed_m, sensed.robot, condition_.self_filter, workspace,
                  sensed.obstacles);
      PhantomWorkspace phantoms;
      drop_phantoms(sensed.camera, sensed.sensed_m, condition_.phantom_radius_m, phantoms,
                    sensed.obstacles);
    }
    return sensed;
  }

  std::vector<WholeRobotEstimate> ask(const std::vector<PosedSpace>& posed) const {
    UnknownSpace space;
    space.assign(posed);
    MeshWorkspace workspace;
    std::vector<WholeLinkDistance> answers;
    mesh_distances(*build_robot_patches(robot_.model), drawn_.scene.pose, space,
                   {.range_m = kTrialRange_m, .tolerance_m = 0.0001}, workspace, answers);
    const auto length_m = [](const SpacePair& pair) {
      return pair.is_known() ? pair.distance_m : std::numeric_limits<double>::infinity();
    };
    std::vector<WholeRobotEstimate> estimates;
    for (const WholeLinkDistance& answer : answers) {
      estimates.push_back({length_m(answer.nearest), length_m(answer.occupied)});
    }
    return estimates;
  }

  const TrialRobot& robot_;
  const sim::DrawnViews& drawn_;
  const WholeRobotCondition& condition_;
  const std::uint32_t seed_;
  std::vector<SensedView> views_;
};

}  // namespace

std::vector<WholeRobotCondition> whole_robot_conditions() {
  const PoseErrors off{.offset_m = 0.01, .angle_rad = 0.0052};
  std::vector<WholeRobotCondition> conditions;
  const auto add = [&](const char* name, MeasuredFilter filter) -> WholeRobotCondition& {
    conditions.push_back({.name = name, .filter = filter});
    return conditions.back();
  };
  add("clean images, ideal filter", MeasuredFilter::ideal);
  add("clean images, default filter", MeasuredFilter::berth);
  add("sensor, ideal filter", MeasuredFilter::ideal).image = sim::kKinectErrors;
  add("sensor, default filter", MeasuredFilter::berth).image = sim::kKinectErrors;
  // What calibration finds with this sensor and drawn robots (docs/calibration.md): what is left of
  // the pose's error, and settings. The tolerance is what the noise of 99 % of the readings needs,
  // and 5 mm, at each distance: there calibration would have found that.
  WholeRobotCondition& calibrated =
      add("sensor, after calibration: 1 mm and 0.05° off, tolerance 1 cm + 3.5 mm z², padding 2 cm",
          MeasuredFilter::berth);
  calibrated.image = sim::kKinectErrors;
  calibrated.pose = {.offset_m = 0.001, .angle_rad = 0.0009};
  calibrated.self_filter = narrow_filter();
  calibrated.self_filter.tolerance_m = 0.01;
  calibrated.self_filter.tolerance_per_m2 = 0.0035;
  WholeRobotCondition& narrow =
      add("each camera 1 cm and 0.3° off, filter 2 cm, 2 cm", MeasuredFilter::berth);
  narrow.pose = off;
  narrow.self_filter = narrow_filter();
  WholeRobotCondition& all =
      add("sensor, 1 cm and 0.3° off, default filter", MeasuredFilter::berth);
  all.image = sim::kKinectErrors;
  all.pose = off;
  WholeRobotCondition& dark = add("dark outlines, default filter", MeasuredFilter::berth);
  dark.image = sim::kDarkErrors;
  add("0 to 50 ms out of step, ideal filter", MeasuredFilter::ideal).most_age_s = 0.05;
  WholeRobotCondition& untold = add("… and age not told", MeasuredFilter::ideal);
  untold.most_age_s = 0.05;
  untold.knows_age = false;
  return conditions;
}

WholeRobotTrial run_whole_robot_trial(const TrialRobot& robot,
                                      const sim::DrawnSceneSettings& settings, std::uint32_t seed,
                                      const std::vector<WholeRobotCondition>& conditions) {
  const sim::DrawnViews drawn =
      sim::draw_views(robot.model, robot.link_trees, settings, seed, kMostTrialCameras);
  WholeRobotTrial trial{&robot, seed, truth_of(robot, drawn), {}};
  for (const WholeRobotCondition& condition : conditions) {
    trial.under.push_back(Measured(robot, drawn, condition, seed).estimates());
  }
  return trial;
}

}  // namespace berth::lab
