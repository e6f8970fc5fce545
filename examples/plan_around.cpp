// A way around what the cameras see, by OMPL. Usage: plan_around scene.yaml
// From where the robot stands in the last images to where it stood in the first ones: RRT-Connect,
// then a shorter way by BIT*, and what the exact search says of it.
#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "berth/pipeline/configuration_check.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/scene/open_scene.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

// 3 cm from all that is seen or hidden, 5 mm from the table and the robot itself.
const berth::ConfigurationMargins kMargins{.margin_m = 0.03, .known_margin_m = 0.005};

std::vector<double> numbers_of(const ob::State* state, std::size_t joints) {
  const double* const first = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {first, first + joints};
}

/// A motion is allowed where all of it is free, certified: no steps to choose.
class Motions : public ob::MotionValidator {
 public:
  Motions(const ob::SpaceInformationPtr& space, const berth::ConfigurationCheck& check)
      : ob::MotionValidator(space), check_(check), joints_(space->getStateDimension()) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    berth::Verdict verdict{};
    check_.ask_motions(numbers_of(from, joints_), numbers_of(to, joints_), kMargins, {&verdict, 1});
    ++(verdict == berth::Verdict::free ? valid_ : invalid_);
    return verdict == berth::Verdict::free;
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last) const override {
    if (checkMotion(from, to)) return true;
    last.second = 0;
    if (last.first) si_->copyState(last.first, from);
    return false;
  }

 private:
  const berth::ConfigurationCheck& check_;
  std::size_t joints_;
};

/// The least bound of all links at 200 places of the way, by the exact search.
double least_m(const og::PathGeometric& path, const std::shared_ptr<const berth::Robot>& robot,
               const std::vector<std::shared_ptr<const berth::Frame>>& frames) {
  og::PathGeometric fine = path;
  fine.interpolate(200);
  berth::Query query(robot);
  double least = std::numeric_limits<double>::infinity();
  for (const ob::State* state : fine.getStates()) {
    const berth::JointState joints{0, numbers_of(state, robot->model().joints.size())};
    for (const berth::LinkResult& link : query.ask({.frames = frames, .joints = joints}).links) {
      if (link.is_moved) least = std::min<double>(least, link.lower_bound_m);
    }
  }
  return least;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: plan_around scene.yaml\n"), 2;
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
  ompl::RNG::setSeed(1);
  const berth::OpenScene scene = berth::open_scene(argv[1]);
  const berth::RobotModel& model = scene.robot->model();
  std::vector<std::shared_ptr<const berth::Frame>> frames;
  for (const berth::OpenCamera& camera : scene.cameras) {
    auto frame = std::make_shared<berth::Frame>();
    const std::size_t last = camera.at_exposure.size() - 1;
    berth::Observer(camera.mounted)
        .observe(camera.read_depth(last), camera.at_exposure[last], *frame, {}, {});
    frames.push_back(std::move(frame));
  }
  berth::ConfigurationCheck check(scene.robot);
  if (check.prepare(frames) == berth::ResultStatus::stale) {
    return std::fprintf(stderr, "no camera can be used\n"), 1;
  }

  const auto joints = static_cast<unsigned>(model.joints.size());
  auto space = std::make_shared<ob::RealVectorStateSpace>(joints);
  ob::RealVectorBounds bounds(joints);
  for (unsigned j = 0; j < joints; ++j) {
    bounds.setLow(j, std::max(model.joints[j].lower, -3.1));
    bounds.setHigh(j, std::min(model.joints[j].upper, 3.1));
  }
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  const ob::SpaceInformationPtr& information = setup.getSpaceInformation();
  setup.setStateValidityChecker([&](const ob::State* state) {
    berth::Verdict verdict{};
    check.ask(numbers_of(state, joints), kMargins, {&verdict, 1});
    return verdict == berth::Verdict::free;
  });
  const auto motions = std::make_shared<Motions>(information, check);
  information->setMotionValidator(motions);
  setup.setOptimizationObjective(
      std::make_shared<ob::PathLengthOptimizationObjective>(information));
  ob::ScopedState<> start(space), goal(space);
  for (unsigned j = 0; j < joints; ++j) start[j] = scene.cameras[0].at_exposure.back().position[j];
  // A free one that the straight way does not lead to.
  information->setup();
  do {
    goal.random();
  } while (!information->isValid(goal.get()) || motions->checkMotion(start.get(), goal.get()));
  setup.setStartAndGoalStates(start, goal);

  const auto solve = [&](const ob::PlannerPtr& planner, double most_s) {
    setup.clear();
    setup.setPlanner(planner);
    const auto begin = std::chrono::steady_clock::now();
    const bool is_solved = setup.solve(most_s) == ob::PlannerStatus::EXACT_SOLUTION;
    const double took_s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!is_solved) return std::printf("%s: no way\n", planner->getName().c_str()), false;
    std::printf("%s: %.3f s, %.2f rad long, nothing nearer than %.3f m\n",
                planner->getName().c_str(), took_s, setup.getSolutionPath().length(),
                least_m(setup.getSolutionPath(), scene.robot, frames));
    return true;
  };
  const bool is_solved = solve(std::make_shared<og::RRTConnect>(information), 10) &&
                         solve(std::make_shared<og::BITstar>(information, "kBITstar"), 1);
  return is_solved ? 0 : 1;
}
