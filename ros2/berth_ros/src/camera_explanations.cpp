#include "camera_explanations.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

#include "camera_input.hpp"

namespace berth_ros {
namespace {

/// How many images of each camera are looked at, each of another pose.
constexpr std::size_t kImages = 6;
/// Two poses differ where a joint does by this, rad or m.
constexpr double kOtherPose = 0.05;
constexpr double kBetweenImages_s = 0.4;
/// How long an image may let wait for itself.
constexpr double kImageWait_s = 0.1;
/// A robot that stands still gives no more images: then a suspicion is explained by those that
/// there are.
constexpr int kTriesForAnotherPose = 10;
/// For one second of looking.
constexpr double kRest = 30;
constexpr double kLeastRest_s = 2;

double steady_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// What this thread has taken of a processor.
double busy_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Of this thread alone, as Linux has it.
void be_less_urgent() { setpriority(PRIO_PROCESS, 0, 5); }

}  // namespace

CameraExplanations::CameraExplanations(std::vector<CameraSettings> cameras, FindJoints find_joints,
                                       OnLook on_look)
    : settings_(std::move(cameras)),
      find_joints_(std::move(find_joints)),
      on_look_(std::move(on_look)),
      cameras_(settings_.size()) {
  thread_ = std::thread([this] { run(); });
}

CameraExplanations::~CameraExplanations() {
  {
    const std::lock_guard lock(mutex_);
    is_stopped_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void CameraExplanations::put(std::size_t camera, const berth::Frame& frame,
                             const std::shared_ptr<const sensor_msgs::msg::Image>& image) {
  // Where the robot is taken out already there is nothing to look at, and where a camera moves
  // otherwise than by the robot's joints it stands elsewhere in each image.
  const berth::CameraMount& mount = frame.mounted->mount();
  if (settings_[camera].is_filtered || frame.time.status != berth::TimeStatus::ok ||
      !is_same_place(frame.X_PC, mount.X_PC)) {
    return;
  }
  const std::lock_guard lock(mutex_);
  Camera& of = cameras_[camera];
  of.is_suspected = !frame.watch.is_trusted() || frame.watch.is_unconfirmed;
  of.is_new = of.newest.mounted && !is_same_mount(of.newest.mounted->mount(), mount);
  if (!of.is_wanted) return;
  const auto joints = find_joints_();
  if (!joints) return;
  Taken taken{frame.mounted, image, {}};
  const double exposure_s = frame.stamp_s + settings_[camera].live.clock_offset_s;
  const berth::FrameTime time = joints->buffer().at(
      exposure_s, frame.mounted->robot()->settings().time.joints, taken.at_exposure);
  if (time.status != berth::TimeStatus::ok) return;
  of.taken = std::move(taken);
  of.is_wanted = false;
}

void CameraExplanations::forget() {
  const std::lock_guard lock(mutex_);
  ++forgotten_;
  for (Camera& camera : cameras_) camera.newest = {};
}

CameraExplanation CameraExplanations::newest(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return cameras_[camera].newest;
}

void CameraExplanations::run() {
  be_less_urgent();
  try {
    while (true) {
      collect();
      const double begin_s = busy_s();
      try {
        look();
      } catch (const std::exception& error) {
        tell_failure(error.what());
      }
      rest(busy_s() - begin_s);
    }
  } catch (const Stopped&) {
  }
}

void CameraExplanations::tell_failure(const std::string& what) {
  const std::lock_guard lock(mutex_);
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (cameras_[c].newest.is_sure) continue;
    cameras_[c].newest.mounted = cameras_[c].kept.mounted;
    cameras_[c].newest.text = "camera " + settings_[c].name + " could not be looked at: " + what;
  }
}

void CameraExplanations::stop_if_asked() const {
  const std::lock_guard lock(mutex_);
  if (is_stopped_) throw Stopped();
}

void CameraExplanations::sleep(double seconds) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return is_stopped_; });
  if (is_stopped_) throw Stopped();
}

void CameraExplanations::rest(double took_s) {
  sleep(kLeastRest_s);
  const double end_s = steady_s() + kRest * took_s;
  while (steady_s() < end_s && !is_any(&Camera::is_new)) sleep(kBetweenImages_s);
}

bool CameraExplanations::is_any(bool Camera::*what) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(cameras_, what);
}

/// Until there is enough to look at.
void CameraExplanations::collect() {
  for (Camera& camera : cameras_) camera.kept.images.clear();
  last_positions_.clear();
  for (int tries = 0; !is_any_full(); ++tries) {
    const std::vector<std::optional<Taken>> taken = take_images();
    const auto first = std::ranges::find_if(taken, [](const auto& one) { return one.has_value(); });
    if (first != taken.end() && has_moved((*first)->at_exposure.position)) {
      tries = 0;
      last_positions_ = (*first)->at_exposure.position;
      for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c]) keep(c, *taken[c]);
      }
    }
    const bool stands_still = !last_positions_.empty() && tries >= kTriesForAnotherPose;
    if (stands_still && is_any(&Camera::is_suspected)) return;
    sleep(kBetweenImages_s);
  }
}

bool CameraExplanations::is_any_full() const {
  return std::ranges::any_of(
      cameras_, [](const Camera& camera) { return camera.kept.images.size() >= kImages; });
}

std::vector<std::optional<CameraExplanations::Taken>> CameraExplanations::take_images() {
  const auto want = [this](bool is_wanted) {
    std::vector<std::optional<Taken>> taken;
    const std::lock_guard lock(mutex_);
    for (Camera& camera : cameras_) {
      camera.is_wanted = is_wanted;
      taken.push_back(std::exchange(camera.taken, std::nullopt));
    }
    return taken;
  };
  want(true);
  sleep(kImageWait_s);
  return want(false);
}

bool CameraExplanations::has_moved(const std::vector<double>& positions) const {
  return !std::ranges::equal(positions, last_positions_,
                             [](double a, double b) { return std::abs(a - b) < kOtherPose; });
}

void CameraExplanations::keep(std::size_t camera, const Taken& taken) {
  berth::LiveImages& kept = cameras_[camera].kept;
  if (kept.mounted != taken.mounted) kept.images.clear();
  kept.mounted = taken.mounted;
  // A wrong unit takes all readings out of the camera's limits.
  berth::DepthUnits units = settings_[camera].units;
  units.near_m = 0;
  units.far_m = std::numeric_limits<double>::infinity();
  kept.depth_scale_m = units.scale_m;
  berth::DepthImage depth_m;
  berth::read_raw_depth(raw_of(*taken.image), taken.mounted->camera(), units, depth_m);
  kept.images.push_back(
      {std::make_shared<const berth::DepthImage>(std::move(depth_m)), taken.at_exposure});
}

void CameraExplanations::look() {
  std::vector<berth::LiveImages> looked_at;
  std::vector<std::size_t> numbers;
  std::int64_t forgotten = 0;
  {
    const std::lock_guard lock(mutex_);
    forgotten = forgotten_;
  }
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const berth::LiveImages& kept = cameras_[c].kept;
    // Of a robot that was made anew meanwhile there is no whole set.
    if (kept.images.empty()) continue;
    if (!looked_at.empty() && kept.mounted->robot() != looked_at[0].mounted->robot()) continue;
    looked_at.push_back(kept);
    numbers.push_back(c);
  }
  if (looked_at.empty()) return;
  const auto found = berth::find_implausible(looked_at, [this] { stop_if_asked(); });
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto told = take(numbers[i], found[i], forgotten);
    if (told) on_look_(numbers[i], *told);
  }
}

std::optional<CameraExplanation> CameraExplanations::take(std::size_t camera,
                                                          const berth::CameraPlausibility& found,
                                                          std::int64_t forgotten) {
  const std::lock_guard lock(mutex_);
  if (forgotten != forgotten_) return std::nullopt;
  CameraExplanation& newest = cameras_[camera].newest;
  const berth::LiveImages& kept = cameras_[camera].kept;
  const bool is_sure = kept.images.size() >= berth::kLeastPosesForFocalLength;
  const bool is_known_wrong = newest.is_sure && !newest.text.empty() &&
                              is_same_mount(newest.mounted->mount(), kept.mounted->mount());
  ++newest.looks;
  // Few images of a robot that stands still acquit nobody.
  if (is_known_wrong && !is_sure) return std::nullopt;
  newest.mounted = kept.mounted;
  newest.is_sure = is_sure;
  newest.text = found.is_implausible ? berth::text_of(found) : "";
  return newest;
}

}  // namespace berth_ros
