#include "berth/pipeline/look_ahead.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "berth/pipeline/link_searches.hpp"

namespace berth {
namespace {

bool is_nearer(const std::vector<WholeLinkDistance>& links, double limit_m) {
  return std::any_of(links.begin(), links.end(), [limit_m](const WholeLinkDistance& link) {
    return link.nearest.lower_bound_m < limit_m;
  });
}

}  // namespace

struct LookAheadSearch::Workers {
  explicit Workers(const std::shared_ptr<const Robot>& robot)
      : searches([robot] { return LinkSearches(robot); }) {}
  tbb::enumerable_thread_specific<LinkSearches> searches;
};

LookAheadSearch::LookAheadSearch(std::shared_ptr<const Robot> robot)
    : robot_(std::move(robot)), workers_(std::make_unique<Workers>(robot_)) {}

LookAheadSearch::~LookAheadSearch() = default;

void LookAheadSearch::ask(const FrameSet& frames, std::span<const JointState> joints,
                          double nearer_than_m, LookAhead& out) {
  poses_.resize(joints.size());
  for (std::size_t i = 0; i < joints.size(); ++i) {
    forward_kinematics(robot_->model(), joints[i].position, poses_[i]);
  }
  out.poses.resize(joints.size());
  tbb::parallel_for(std::size_t{0}, out.poses.size(), [&](std::size_t i) {
    // Else a waiting thread would begin another pose on top of this one, with its search.
    tbb::this_task_arena::isolate(
        [&] { workers_->searches.local().ask(frames, poses_[i], out.poses[i]); });
  });
  const auto first = std::find_if(out.poses.begin(), out.poses.end(), [&](const auto& links) {
    return is_nearer(links, nearer_than_m);
  });
  if (first != out.poses.end()) out.first_nearer = first - out.poses.begin();
}

}  // namespace berth
