#include "exposure_answers.hpp"

#include "result_messages.hpp"

namespace berth_ros {
namespace {

/// How many frames one camera may be behind another.
constexpr std::size_t kKeptFrames = 4;

}  // namespace

void ExposureAnswers::use(std::shared_ptr<const berth::Robot> robot,
                          const std::vector<std::string>& cameras) {
  const std::lock_guard lock(mutex_);
  query_.reset();
  recent_.assign(cameras.size(), {});
  robot_ = std::move(robot);
  if (robot_) query_.emplace(robot_, cameras);
}

bool ExposureAnswers::ask(std::size_t camera, const std::shared_ptr<const berth::Frame>& frame,
                          const rclcpp::Time& now, const StampClock& clock,
                          berth_msgs::msg::LinkDistances& message) {
  const std::lock_guard lock(mutex_);
  if (frame->mounted->robot() != robot_) return false;
  auto& recent = recent_[camera];
  if (recent.size() == kKeptFrames) recent.pop_front();
  recent.push_back(frame);
  const LiveFrames frames = frames_at(frame->stamp_s);
  const std::string& base_frame = robot_->model().links.front().name;
  to_message(query_->ask({.frames = frames}), base_frame, now, clock, message);
  return true;
}

LiveFrames ExposureAnswers::frames_at(double stamp_s) const {
  LiveFrames frames(recent_.size());
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (const auto& frame : recent_[k]) {
      if (frame && frame->stamp_s <= stamp_s) frames[k] = frame;
    }
  }
  return frames;
}

}  // namespace berth_ros
