// MotionBenchMaker's problems (Chamzas and others 2022), planned by OMPL on what drawn cameras
// see of each scene, and held against its exact geometry.
#include <fmt/format.h>
#include <ompl/base/MotionValidator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>
#include <yaml-cpp/yaml.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "apps/support/command_options.hpp"
#include "apps/support/program.hpp"
#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/robot/primitives.hpp"
#include "lab/measure/stopwatch.hpp"
#include "lab/stream/film.hpp"
#include "lab/trust/trial.hpp"
#include "sim/drawn_scene.hpp"

namespace berth::lab {
namespace {

namespace fs = std::filesystem;
namespace ob = ompl::base;
namespace og = ompl::geometric;

struct Options {
  fs::path problems, urdf;
  int least = 1, most = 100, step = 1;
  double most_s = 5;
  double margin_m = 0.005;
  std::size_t random = 200;
  /// Links that may touch what they take: nobody asks about them.
  std::vector<std::string> without;
  /// More cameras than three: where each is and where it looks, six numbers in the robot's root.
  std::vector<double> cameras;
};

/// A problem's things around the robot's root, and where its joints start and have to go.
struct Problem {
  std::vector<sim::DrawnObstacle> things;
  /// Of each thing.
  std::vector<sim::MeshTree> trees;
  std::vector<double> start, goal;
};

TriangleMesh mesh_of(const YAML::Node& primitive) {
  const auto size = primitive["dimensions"].as<std::vector<double>>();
  if (primitive["type"].as<std::string>() == "box") return make_box({size[0], size[1], size[2]});
  return make_cylinder(size[1], size[0]);
}

Pose pose_of(const YAML::Node& pose) {
  const auto at = pose["position"].as<std::vector<double>>();
  const auto q = pose["orientation"].as<std::vector<double>>();
  return Eigen::Translation3d(at[0], at[1], at[2]) *
         Eigen::Quaterniond(q[3], q[0], q[1], q[2]).normalized();
}

Problem read_problem(const fs::path& folder, int number, const RobotModel& model) {
  Problem problem;
  const YAML::Node scene = YAML::LoadFile(folder / fmt::format("scene{:04}.yaml", number));
  for (const YAML::Node& object : scene["world"]["collision_objects"]) {
    const Pose X_BO = object["pose"] ? pose_of(object["pose"]) : Pose::Identity();
    for (std::size_t i = 0; i < object["primitives"].size(); ++i) {
      problem.things.push_back(
          {mesh_of(object["primitives"][i]), X_BO * pose_of(object["primitive_poses"][i])});
      problem.trees.push_back(sim::build_mesh_tree(problem.things.back().mesh_O));
    }
  }
  const YAML::Node request = YAML::LoadFile(folder / fmt::format("request{:04}.yaml", number));
  std::map<std::string, double> start, goal;
  const YAML::Node joints = request["start_state"]["joint_state"];
  for (std::size_t i = 0; i < joints["name"].size(); ++i) {
    start[joints["name"][i].as<std::string>()] = joints["position"][i].as<double>();
  }
  goal = start;
  for (const YAML::Node& one : request["goal_constraints"][0]["joint_constraints"]) {
    goal[one["joint_name"].as<std::string>()] = one["position"].as<double>();
  }
  for (const MovableJoint& joint : model.joints) {
    problem.start.push_back(std::min(start.at(joint.name), joint.upper));
    problem.goal.push_back(std::min(goal.at(joint.name), joint.upper));
  }
  return problem;
}

Pose looking(const Eigen::Vector3d& at, const Eigen::Vector3d& to) {
  const Eigen::Vector3d z = (to - at).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  Pose X_BC = Pose::Identity();
  X_BC.linear().col(0) = x;
  X_BC.linear().col(1) = z.cross(x);
  X_BC.linear().col(2) = z;
  X_BC.translation() = at;
  return X_BC;
}

/// Three cameras around the robot, in a room in which all rays end, and those that are added.
std::vector<Pose> camera_poses(const std::vector<double>& added) {
  std::vector<Pose> poses;
  for (int k = 0; k < 3; ++k) {
    const double angle_rad = 2 * std::numbers::pi * (k + 0.5) / 3;
    poses.push_back(
        looking({1.9 * std::cos(angle_rad), 1.9 * std::sin(angle_rad), 1.4}, {0, 0, 0.45}));
  }
  for (std::size_t k = 0; k + 6 <= added.size(); k += 6) {
    poses.push_back(looking({added[k], added[k + 1], added[k + 2]},
                            {added[k + 3], added[k + 4], added[k + 5]}));
  }
  return poses;
}

void add_walls(std::vector<sim::DrawnObstacle>& things) {
  const auto add = [&](const Eigen::Vector3d& size_m, const Eigen::Vector3d& at_m) {
    things.push_back({make_box(size_m), Pose(Eigen::Translation3d(at_m))});
  };
  add({8, 8, 0.1}, {0, 0, -1});
  for (const double side : {-1.0, 1.0}) {
    add({0.1, 8, 5}, {4 * side, 0, 1.5});
    add({8, 0.1, 5}, {0, 4 * side, 1.5});
  }
}

/// Of all problems of one kind.
struct Counts {
  int problems = 0, start_free = 0, goal_free = 0, goal_near = 0, solved = 0;
  /// Whose goal is nearer than the margin to the things themselves: no camera helps.
  int goal_too_near = 0;
  /// Whose goal is free or resolved to be.
  int goal_resolved = 0;
  /// Of drawn configurations and the ways' places: those that touch something, by what the check
  /// said of them; and those that touch nothing.
  std::size_t colliding = 0, colliding_free = 0, clear = 0, clear_not_free = 0;
  std::vector<double> plan_ms, prepare_ms;
};

class Planner {
 public:
  Planner(const TrialRobot& robot, const Options& options)
      : robot_(std::make_shared<const Robot>(robot.model)),
        trial_(robot),
        options_(options),
        check_(robot_),
        margins_{.margin_m = options.margin_m, .without = options.without, .known_margin_m = 0} {}

  void solve(const Problem& problem, Counts& counts) {
    prepare(problem, counts);
    ++counts.problems;
    const Verdict start = verdict_of(problem.start), goal = verdict_of(problem.goal);
    counts.start_free += start == Verdict::free;
    counts.goal_free += goal == Verdict::free;
    counts.goal_near += goal == Verdict::near;
    counts.goal_resolved += resolved_of(problem.goal) == Verdict::free;
    counts.goal_too_near += is_touching(problem, problem.goal, options_.margin_m);
    sim::Random random(static_cast<std::uint32_t>(counts.problems));
    for (std::size_t i = 0; i < options_.random; ++i) {
      hold(problem, sim::draw_joints(random, robot_->model()).position, counts);
    }
    if (start != Verdict::free || goal != Verdict::free) return;
    plan(problem, counts);
  }

 private:
  void prepare(const Problem& problem, Counts& counts) {
    std::vector<sim::DrawnObstacle> things = problem.things;
    add_walls(things);
    const Camera camera{640, 480, 460, 460, 319.5, 239.5};
    CameraSettings settings;
    settings.watch.min_at_robot = 0;
    frames_.clear();
    int number = 0;
    for (const Pose& X_BC : camera_poses(options_.cameras)) {
      const auto mounted = std::make_shared<const MountedCamera>(
          robot_,
          CameraMount{camera, robot_->model().links.front().name, X_BC,
                      fmt::format("camera_{}", number++)},
          settings);
      RobotPose pose;
      forward_kinematics(robot_->model(), problem.start, pose);
      RobotImage seen;
      RobotRenderer(robot_->meshes(), camera).render(pose, X_BC, seen);
      const DepthImage depth_m =
          drawn_over(seen.depth_m, sim::cast_obstacles(things, camera, X_BC));
      auto frame = std::make_shared<Frame>();
      Observer(mounted).observe(depth_m, JointState{0, problem.start}, *frame);
      frames_.push_back(std::move(frame));
    }
    const Stopwatch preparing(CLOCK_THREAD_CPUTIME_ID);
    check_.prepare(frames_);
    counts.prepare_ms.push_back(preparing.ms());
  }

  Verdict verdict_of(const std::vector<double>& positions) const {
    Verdict verdict{};
    check_.ask(positions, margins_, {&verdict, 1});
    return verdict;
  }

  Verdict resolved_of(const std::vector<double>& positions) const {
    Verdict verdict = verdict_of(positions);
    check_.resolve(positions, margins_, {&verdict, 1});
    return verdict;
  }

  /// Whether the robot touches one of the things, or is as near, surface to surface.
  bool is_touching(const Problem& problem, const std::vector<double>& positions,
                   double within_m = 1e-4) const {
    RobotPose pose;
    forward_kinematics(robot_->model(), positions, pose);
    for (std::size_t i = 0; i < problem.things.size(); ++i) {
      for (const std::size_t link : robot_->model().evaluated_links) {
        if (!robot_->model().is_moved(link)) continue;
        const std::string& name = robot_->model().links[link].name;
        if (std::ranges::find(options_.without, name) != options_.without.end()) continue;
        const auto found = sim::closest_points(trial_.link_trees[link], pose.X_BL[link],
                                               problem.trees[i], problem.things[i].X_BO, within_m);
        if (std::isfinite(found.distance_m)) return true;
      }
    }
    return false;
  }

  void hold(const Problem& problem, const std::vector<double>& positions, Counts& counts) const {
    Verdict verdict{};
    // Of the things alone: the truth knows no self-collision.
    check_.ask(positions, {.margin_m = options_.margin_m, .without = options_.without},
               {&verdict, 1});
    if (is_touching(problem, positions)) {
      ++counts.colliding;
      counts.colliding_free += verdict == Verdict::free;
    } else {
      ++counts.clear;
      counts.clear_not_free += verdict != Verdict::free;
    }
  }

  class Motions : public ob::MotionValidator {
   public:
    Motions(const ob::SpaceInformationPtr& space, const Planner& planner)
        : ob::MotionValidator(space), planner_(planner) {}
    bool checkMotion(const ob::State* from, const ob::State* to) const override {
      Verdict verdict{};
      planner_.check_.ask_motions(planner_.numbers_of(from), planner_.numbers_of(to),
                                  planner_.margins_, {&verdict, 1});
      return verdict == Verdict::free;
    }
    bool checkMotion(const ob::State* from, const ob::State* to,
                     std::pair<ob::State*, double>& last) const override {
      last.second = 0;
      return checkMotion(from, to);
    }

   private:
    const Planner& planner_;
  };

  std::vector<double> numbers_of(const ob::State* state) const {
    const double* const first = state->as<ob::RealVectorStateSpace::StateType>()->values;
    return {first, first + robot_->model().joints.size()};
  }

  void plan(const Problem& problem, Counts& counts) {
    const auto joints = static_cast<unsigned>(robot_->model().joints.size());
    const auto space = std::make_shared<ob::RealVectorStateSpace>(joints);
    ob::RealVectorBounds bounds(joints);
    for (unsigned j = 0; j < joints; ++j) {
      // Fingers stay as they are.
      const bool stays = problem.start[j] == problem.goal[j];
      bounds.setLow(j, stays ? problem.start[j] - 1e-6 : robot_->model().joints[j].lower);
      bounds.setHigh(j, stays ? problem.start[j] + 1e-6 : robot_->model().joints[j].upper);
    }
    space->setBounds(bounds);
    og::SimpleSetup setup(space);
    setup.setStateValidityChecker(
        [&](const ob::State* state) { return verdict_of(numbers_of(state)) == Verdict::free; });
    const ob::SpaceInformationPtr& information = setup.getSpaceInformation();
    information->setMotionValidator(std::make_shared<Motions>(information, *this));
    ob::ScopedState<> start(space), goal(space);
    for (unsigned j = 0; j < joints; ++j) start[j] = problem.start[j], goal[j] = problem.goal[j];
    setup.setStartAndGoalStates(start, goal);
    setup.setPlanner(std::make_shared<og::RRTConnect>(information));
    const Stopwatch planning(CLOCK_THREAD_CPUTIME_ID);
    const bool is_solved = setup.solve(options_.most_s) == ob::PlannerStatus::EXACT_SOLUTION;
    if (!is_solved) return;
    ++counts.solved;
    counts.plan_ms.push_back(planning.ms());
    og::PathGeometric path = setup.getSolutionPath();
    path.interpolate(50);
    for (const ob::State* state : path.getStates()) hold(problem, numbers_of(state), counts);
  }

  std::shared_ptr<const Robot> robot_;
  const TrialRobot& trial_;
  const Options& options_;
  ConfigurationCheck check_;
  ConfigurationMargins margins_;
  std::vector<std::shared_ptr<const Frame>> frames_;
};

double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void run(const Options& options) {
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  ompl::RNG::setSeed(1);
  const TrialRobot robot = make_trial_robot("panda", load_robot({.urdf = options.urdf}));
  fmt::print(
      "| kind | problems | start, goal free, resolved | goal near: by cameras, by the things | "
      "solved | "
      "planning [ms] | the field [ms] | touching: called free | touching nothing: not free |\n"
      "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  std::vector<fs::path> kinds;
  for (const auto& kind : fs::directory_iterator(options.problems)) kinds.push_back(kind.path());
  std::ranges::sort(kinds);
  for (const fs::path& kind : kinds) {
    Planner planner(robot, options);
    Counts c;
    for (int i = options.least; i <= options.most; i += options.step) {
      planner.solve(read_problem(kind, i, robot.model), c);
    }
    fmt::print("| {} | {} | {}, {}, {} | {}, {} | {} | {:.1f} | {:.0f} | {} of {} | {} of {} |\n",
               kind.filename().string(), c.problems, c.start_free, c.goal_free, c.goal_resolved,
               c.goal_near, c.goal_too_near, c.solved, median(c.plan_ms), median(c.prepare_ms),
               c.colliding_free, c.colliding, c.clear_not_free, c.clear);
  }
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  using namespace berth;
  CLI::App program("Plans MotionBenchMaker's problems on what drawn cameras see of them.");
  lab::Options options;
  program.add_option("problems", options.problems, "the folder of a folder for each kind")
      ->required()
      ->check(CLI::ExistingDirectory);
  program.add_option("urdf", options.urdf, "the Panda's URDF")
      ->required()
      ->check(CLI::ExistingFile);
  program.add_option("--least", options.least, "the first problem of each kind");
  program.add_option("--most", options.most, "the last one");
  program.add_option("--step", options.step, "from one to the next")->check(CLI::Range(1, 1000));
  program
      .add_option("--camera", options.cameras,
                  "one more than three: where it is and where it looks, in m; may stand five times")
      ->expected(6)
      ->type_name("X Y Z X Y Z")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  program.add_option("--seconds", options.most_s, "to plan at most");
  program.add_option("--without", options.without, "links that are not asked about");
  program.add_option("--margin-m", options.margin_m, "from all that is seen or hidden");
  if (const auto status = app::parse_command_line(program, argc, argv)) return *status;
  return app::carry_out("measure_problems", 0, [&] { lab::run(options); });
}
