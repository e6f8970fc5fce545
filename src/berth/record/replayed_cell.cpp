#include "berth/record/replayed_cell.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "berth/pipeline/prepared_space.hpp"

namespace berth {
namespace {

/// What the watch said is in the recording.
std::optional<double> measure_nothing(DepthView, const JointState&, const Pose&,
                                      const std::stop_token&) {
  return std::nullopt;
}

}  // namespace

ReplayedCell::ReplayedCell(const RecordedCell& cell) : cell_(cell), frames_(cell.cameras.size()) {}

void ReplayedCell::begin(const RecordedBegin& begin) {
  observers_.clear();
  for (const auto& mounted : cell_.cameras) observers_.emplace_back(mounted, measure_nothing);
  query_.emplace(cell_.robot, begin.camera_names);
  prepared_.reset();
  asked_.clear();
  for (auto& of_camera : frames_) of_camera.clear();
  monitor_.reset();
  if (cell_.separation) monitor_.emplace(cell_.robot, *cell_.separation);
}

void ReplayedCell::set_background(std::size_t camera, DepthView depth_m) {
  observers_.at(camera).set_background(depth_m);
}

void ReplayedCell::observe(std::size_t camera, const RecordedExposure& exposure,
                           DepthView depth_m) {
  const std::shared_ptr<Frame> frame = pool_.take();
  observers_.at(camera).observe(depth_m, exposure.joints, *frame, exposure.time,
                                {exposure.X_PC, exposure.X_WB});
  frame->watch = exposure.watch;
  frames_[camera][exposure.number] = frame;
}

std::vector<std::shared_ptr<const Frame>> ReplayedCell::frames_of(const RecordedRequest& request) {
  std::vector<std::shared_ptr<const Frame>> frames;
  for (const std::uint64_t number : request.frames) {
    frames.emplace_back();
    if (number == 0) continue;
    for (auto& of_camera : frames_) {
      const auto found = of_camera.find(number);
      if (found == of_camera.end()) continue;
      frames.back() = found->second;
      of_camera.erase(of_camera.begin(), found);
    }
    if (!frames.back()) {
      throw std::runtime_error(fmt::format("the image of exposure {} is missing", number));
    }
  }
  return frames;
}

NewestFrames ReplayedCell::newest_of(const RecordedRequest& request,
                                     const std::vector<std::shared_ptr<const Frame>>& frames) {
  if (request.space == RecordedRequest::Space::frames) return frames;
  if (request.space == RecordedRequest::Space::prepared) {
    const auto space = std::make_shared<PreparedSpace>(cell_.robot, frames.size());
    const std::vector<JointState>& at = request.searched_for;
    if (at.empty()) throw std::runtime_error("prepared_for: nothing; expected joints");
    space->prepare(frames, at.front().position.empty() ? nullptr : &at.front());
    for (std::size_t i = 1; i < at.size(); ++i) space->search(at[i]);
    prepared_ = space;
  }
  if (!prepared_) throw std::runtime_error("prepared_for: as before, and nothing was before");
  return prepared_;
}

Result ReplayedCell::ask(const RecordedRequest& request) {
  if (!query_) throw std::runtime_error("a request before anything began");
  std::vector<std::shared_ptr<const Frame>> frames = frames_of(request);
  Request again{.frames = newest_of(request, frames)};
  if (request.joints) again.joints = {*request.joints, request.joints_status};
  again.now_s = request.now_s;
  again.X_WB = request.X_WB;
  Result result = query_->ask(again);
  asked_ = std::move(frames);
  if (request.is_monitored) result.separation = update(request.motion, result);
  return result;
}

Separation ReplayedCell::update(const RecordedMotion& motion, const Result& result) {
  if (!monitor_) throw std::runtime_error("a monitor's result without a monitor's settings");
  monitor_->recall(motion.before);
  return monitor_->update(result, {motion.velocity, motion.path}, motion.now_s,
                          motion.has_frames ? &query_->frames() : nullptr);
}

}  // namespace berth
