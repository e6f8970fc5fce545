#include "berth/pipeline/trajectory.hpp"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <stdexcept>

#include "berth/pipeline/mesh_asker.hpp"

namespace berth {
namespace {

bool is_nearer(const std::vector<WholeLinkDistance>& links, double limit_m) {
  return std::any_of(links.begin(), links.end(), [limit_m](const WholeLinkDistance& link) {
    return link.nearest.lower_bound_m < limit_m;
  });
}

}  // namespace

struct TrajectoryAsker::Workers {
  explicit Workers(const std::shared_ptr<const Robot>& robot) : askers([robot] { return MeshAsker(robot); }) {}
  tbb::enumerable_thread_specific<MeshAsker> askers;
};

TrajectoryAsker::TrajectoryAsker(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), workers_(std::make_unique<Workers>(robot_)) {
  const Method method = robot_->settings().method;
  if (method == Method::mesh) return;
  throw std::invalid_argument(fmt::format(
      "method {}: asks pictures of the robot; expected mesh for a trajectory", name_of(method)));
}

TrajectoryAsker::~TrajectoryAsker() = default;

const TrajectoryAnswer& TrajectoryAsker::ask(const FrameSet& frames,
                                             std::span<const JointState> joints,
                                             double nearer_than_m, std::optional<double> now_s) {
  if (!std::isfinite(nearer_than_m) || nearer_than_m < 0) {
    throw std::invalid_argument(fmt::format(
        "trajectory: the limit is {} m; expected a finite number of at least 0", nearer_than_m));
  }
  poses_.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    forward_kinematics(robot_->model(), joints[i].position, poses_[i]);
  }
  answer_.first_nearer.reset();
  answer_.time = timeliness_of(frames, now_s, robot_->settings().time);
  answer_.poses.resize(answer_.time.status == TimeStatus::ok ? joints.size() : 0);
  tbb::parallel_for(std::size_t{0}, answer_.poses.size(), [&](std::size_t i) {
    // Else a waiting thread would begin another pose on top of this one, with its asker.
    tbb::this_task_arena::isolate(
        [&] { workers_->askers.local().ask(frames, poses_[i], answer_.poses[i]); });
  });
  for (std::size_t i = 0; i < answer_.poses.size() && !answer_.first_nearer; ++i) {
    if (is_nearer(answer_.poses[i], nearer_than_m)) answer_.first_nearer = i;
  }
  return answer_;
}

}  // namespace berth
