#include "black_box.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

namespace berth_ros {

BlackBox::BlackBox(berth::RecorderSettings settings, Tell tell)
    : settings_(std::move(settings)), tell_(std::move(tell)) {
  settings_.tell = tell_;
  if (settings_.file.empty()) return;
  const std::filesystem::path folder = std::filesystem::absolute(settings_.file).parent_path();
  if (!std::filesystem::is_directory(folder)) {
    throw std::invalid_argument("record.file: \"" + settings_.file.string() +
                                "\"; expected a file in a folder that is there; " +
                                folder.string() + " is not");
  }
  if (!(settings_.seconds > 0)) {
    throw std::invalid_argument("record.seconds: " + std::to_string(settings_.seconds) +
                                "; expected a number above 0");
  }
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

BlackBox::~BlackBox() = default;

void BlackBox::use(std::shared_ptr<const berth::Robot> robot,
                   std::optional<berth::SeparationSettings> separation, std::size_t cameras) {
  const std::lock_guard lock(mutex_);
  robot_ = std::move(robot);
  separation_ = std::move(separation);
  mounted_.assign(cameras, nullptr);
  retire();
}

void BlackBox::mount(std::size_t camera,
                     const std::shared_ptr<const berth::MountedCamera>& mounted) {
  const std::lock_guard lock(mutex_);
  if (mounted->robot() != robot_) return;
  mounted_[camera] = mounted;
  retire();
}

void BlackBox::retire() {
  if (recorder_) retired_.push_back(std::move(recorder_));
  has_changed_ = true;
  changed_.notify_one();
}

std::unique_ptr<berth::Recorder> BlackBox::make(
    const MountedCameras& cameras, std::optional<berth::SeparationSettings> separation) const {
  MountedCameras known = cameras;
  std::erase(known, nullptr);
  if (known.empty()) return nullptr;
  try {
    const std::shared_ptr<const berth::Robot> robot = known.front()->robot();
    return std::make_unique<berth::Recorder>(robot, std::move(known), std::move(separation),
                                             settings_);
  } catch (const std::exception& error) {
    tell_(error.what());
    return nullptr;
  }
}

void BlackBox::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [&] { return has_changed_; })) {
    has_changed_ = false;
    auto ended = std::exchange(retired_, {});
    const MountedCameras cameras = mounted_;
    const auto separation = separation_;
    lock.unlock();
    ended.clear();
    auto made = make(cameras, separation);
    lock.lock();
    (has_changed_ ? retired_.emplace_back() : recorder_) = std::move(made);
  }
}

void BlackBox::put(std::size_t camera, const berth::Frame& frame, berth::DepthView depth_m) {
  if (settings_.file.empty()) return;
  {
    const std::shared_lock lock(mutex_);
    if (frame.mounted->robot() != robot_) return;
    if (mounted_[camera] == frame.mounted) {
      if (recorder_) recorder_->put(frame, depth_m);
      return;
    }
  }
  mount(camera, frame.mounted);
}

void BlackBox::push_joints(double stamp_s, const std::vector<std::string>& names,
                           const std::vector<double>& positions) {
  const std::shared_lock lock(mutex_);
  if (recorder_) recorder_->push_joints(stamp_s, names, positions);
}

bool BlackBox::knows_all(const berth::Request& request) const {
  return std::ranges::all_of(request.frames.get(), [&](const berth::Frame* frame) {
    return !frame || std::ranges::find(mounted_, frame->mounted) != mounted_.end();
  });
}

bool BlackBox::write() {
  const std::shared_lock lock(mutex_);
  if (recorder_) recorder_->write();
  return recorder_ != nullptr;
}

}  // namespace berth_ros
