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
  views_.assign(cameras, nullptr);
  retire();
}

void BlackBox::mount(std::size_t camera, const std::shared_ptr<const berth::MountedCamera>& view) {
  const std::lock_guard lock(mutex_);
  if (view->robot() != robot_) return;
  views_[camera] = view;
  retire();
}

void BlackBox::retire() {
  if (recorder_) retired_.push_back(std::move(recorder_));
  has_changed_ = true;
  changed_.notify_one();
}

std::unique_ptr<berth::Recorder> BlackBox::make(
    const Views& views, std::optional<berth::SeparationSettings> separation) const {
  Views known = views;
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
    const Views views = views_;
    const auto separation = separation_;
    lock.unlock();
    ended.clear();
    auto made = make(views, separation);
    lock.lock();
    (has_changed_ ? retired_.emplace_back() : recorder_) = std::move(made);
  }
}

void BlackBox::put(std::size_t camera, const berth::Frame& frame, berth::DepthView depth_m) {
  if (settings_.file.empty()) return;
  {
    const std::shared_lock lock(mutex_);
    if (frame.view->robot() != robot_) return;
    if (views_[camera] == frame.view) {
      if (recorder_) recorder_->put(frame, depth_m);
      return;
    }
  }
  mount(camera, frame.view);
}

void BlackBox::push_joints(double stamp_s, const std::vector<std::string>& names,
                           const std::vector<double>& positions) {
  const std::shared_lock lock(mutex_);
  if (recorder_) recorder_->push_joints(stamp_s, names, positions);
}

bool BlackBox::knows_all(const berth::Request& request) const {
  return std::ranges::all_of(request.frames.get(), [&](const berth::Frame* frame) {
    return !frame || std::ranges::find(views_, frame->view) != views_.end();
  });
}

const berth::Result& BlackBox::ask(berth::Query& query, const berth::Request& request) {
  const std::shared_lock lock(mutex_);
  return recorder_ && knows_all(request) ? recorder_->ask(query, request) : query.ask(request);
}

const berth::Separation& BlackBox::update(berth::SeparationMonitor& monitor,
                                          const berth::Result& result,
                                          const berth::PlannedMotion& motion, double now_s,
                                          const berth::FrameSet& frames) {
  const std::shared_lock lock(mutex_);
  return recorder_ ? recorder_->update(monitor, result, motion, now_s, &frames)
                   : monitor.update(result, motion, now_s, &frames);
}

bool BlackBox::write() {
  const std::shared_lock lock(mutex_);
  if (recorder_) recorder_->write();
  return recorder_ != nullptr;
}

}  // namespace berth_ros
