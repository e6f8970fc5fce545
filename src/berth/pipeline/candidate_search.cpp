#include "berth/pipeline/candidate_search.hpp"

#include <algorithm>
#include <numeric>

namespace berth {
namespace {

/// What is farther away holds nobody back.
constexpr double kRange_m = 0.5;
/// Nearer to each other on the link, two pairs say the same.
constexpr float kApart_m = 0.05F;

bool is_apart(const LinkResult& link, const SpacePair& pair) {
  const auto is_far_from = [&](const SpacePair& other) {
    return (other.robot_point_B_m - pair.robot_point_B_m).norm() >= kApart_m;
  };
  return is_far_from(link) && std::ranges::all_of(link.candidates, is_far_from);
}

}  // namespace

CandidateSearch::CandidateSearch(std::shared_ptr<const Robot> robot) : robot_(std::move(robot)) {
  const std::vector<std::size_t>& links = robot_->model().evaluated_links;
  for (const LinkPatches& eighth : robot_->eighths().links) {
    const auto place = std::ranges::find(links, eighth.link) - links.begin();
    places_.push_back(static_cast<std::size_t>(place));
  }
  order_.resize(places_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

void CandidateSearch::search(const FrameSet& frames, const RobotPose& pose, MeshRequest request) {
  request.range_m = std::min(request.range_m, kRange_m);
  mesh_distances(robot_->eighths(), pose, frames.space(), request, workspace_, found_);
}

void CandidateSearch::tell(const FrameSet& frames, Result& out) {
  const auto distance_m = [this](std::size_t i) {
    const SpacePair& pair = found_[i].nearest;
    return pair.is_known() ? pair.distance_m : std::numeric_limits<float>::infinity();
  };
  std::ranges::sort(order_, {}, distance_m);
  const auto most = static_cast<std::size_t>(robot_->settings().candidates - 1);
  for (LinkResult& link : out.links) {
    link.candidates.clear();
    link.candidates.reserve(most);
  }
  for (const std::size_t i : order_) {
    SpacePair pair = found_[i].nearest;
    LinkResult& link = out.links[places_[i]];
    if (!pair.is_known() || link.candidates.size() == most || !is_apart(link, pair)) continue;
    pair.camera = frames.used()[pair.camera];
    link.candidates.emplace_back() = pair;
  }
}

void CandidateSearch::forget() {
  workspace_.forget();
  found_.clear();
}

}  // namespace berth
