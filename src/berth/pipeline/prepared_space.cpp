#include "berth/pipeline/prepared_space.hpp"

#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/link_searches.hpp"

namespace berth {

PreparedSpace::PreparedSpace(std::shared_ptr<const Robot> robot, std::size_t cameras)
    : robot_(std::move(robot)),
      frames_(cameras),
      set_(std::make_unique<FrameSet>()),
      searches_(std::make_unique<LinkSearches>(robot_)) {
  prepare(std::vector(frames_), nullptr);
}

PreparedSpace::~PreparedSpace() = default;

void PreparedSpace::prepare(std::span<const std::shared_ptr<const Frame>> frames,
                            const JointState* joints) {
  asked_.clear();
  for (const auto& frame : frames) {
    asked_.push_back(frame.get());
  }
  frames_.assign(frames.begin(), frames.end());
  set_->assign(asked_, robot_->settings().time);
  searches_->forget();
  searches_made_ = 0;
  note_search(joints);
  if (!set_->newest()) return;
  if (joints) return search_at(*joints);
  searches_->prepare(*set_, set_->newest()->pose);
}

void PreparedSpace::search(const JointState& joints) {
  note_search(&joints);
  search_at(joints);
}

void PreparedSpace::note_search(const JointState* joints) {
  if (searches_made_ == searched_for_.size()) searched_for_.emplace_back();
  JointState& noted = searched_for_[searches_made_++];
  noted.stamp_s = joints ? joints->stamp_s : 0;
  noted.position.clear();
  if (joints) noted.position = joints->position;
}

void PreparedSpace::search_at(const JointState& joints) {
  if (!set_->newest()) return;
  forward_kinematics(robot_->model(), joints.position, pose_);
  searches_->prepare(*set_, pose_);
}

}  // namespace berth
