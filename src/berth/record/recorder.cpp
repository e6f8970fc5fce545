#include "berth/record/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/record/tape.hpp"

namespace berth {
namespace {

/// Recordings begin anew so often in the ring's time.
constexpr double kSegments = 4;
/// A clock that jumps says nothing about how much was recorded.
constexpr double kMostStep_s = 1;

double steady_now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void require(bool holds, const char* name, double value, const char* expected) {
  if (holds) return;
  throw std::invalid_argument(fmt::format("{}: {}; expected {}", name, value, expected));
}

void validate(const RecorderSettings& s) {
  require(std::isfinite(s.seconds) && s.seconds > 0, "seconds", s.seconds,
          "a finite number above 0");
  require(std::isfinite(s.after_stop_s) && s.after_stop_s >= 0, "after_stop_s", s.after_stop_s,
          "a finite number of at least 0");
  require(s.most_files >= 1, "most_files", s.most_files, "1 or more");
}

void copy(DepthView from, DepthImage& to) {
  to.resize(from.width, from.height, kNoDepth);
  for (int v = 0; v < from.height; ++v) std::copy_n(from.row(v), from.width, to.row(v));
}

}  // namespace

using KeptImage = std::shared_ptr<const RecordedImage>;

/// The most images of each camera that are kept without a request.
constexpr std::size_t kMostKept = 64;

/// The images of one camera that a request may still be about.
class KeptImages {
 public:
  void put(KeptImage image) {
    images_.push_back(std::move(image));
    if (images_.size() > kMostKept) images_.erase(images_.begin());
  }
  /// What comes does not go on from these.
  void lose() { images_.clear(); }
  bool holds(std::uint64_t number) const {
    return std::ranges::any_of(images_, [=](const KeptImage& image) { return is(image, number); });
  }
  /// Nothing before this frame will be asked any more.
  void drop_before(std::uint64_t number) {
    images_.erase(images_.begin(), std::ranges::find_if(images_, [=](const KeptImage& image) {
                    return is(image, number);
                  }));
  }
  const std::vector<KeptImage>& images() const { return images_; }

 private:
  static bool is(const KeptImage& image, std::uint64_t number) {
    return image->exposure.number == number;
  }

  std::vector<KeptImage> images_;
};

struct Recorder::Parts {
  Parts(RecordedCell of, RecorderSettings with);

  std::size_t camera_of(const MountedCamera* mounted) const;
  void put(KeptImage image);

  /// In the loop's thread.
  bool begins_with(const Query& query, const Request& request);
  /// Whether the request can be recorded; if not, it is lost.
  bool open(const Query& query, const Request& request, bool begins);
  /// What a segment that begins with this request has to have.
  void open_segment(const Query& query);
  /// Images that are not among those that the segment begins with.
  void add_needed();
  void fill(const Request& request, const JointState* joints, TimeStatus joints_status,
            const Result& result);
  void fill_space(const NewestFrames& frames);
  void close();
  void pass(const Request& request);
  void lose_request();
  bool are_kept(const Request& request);

  RecordedCell cell;
  RecorderSettings settings;
  Tape tape;
  Pool<RecordedImage> images;

  /// Of all threads.
  mutable std::mutex mutex;
  std::vector<KeptImages> kept;
  std::vector<KeptImage> backgrounds;
  /// All that could not be recorded.
  std::int64_t lost_images = 0, lost_requests = 0;
  /// How much of that is told by segments.
  std::int64_t told_images = 0, told_requests = 0;
  /// Something is missing since the segment began.
  bool is_broken = true;

  /// Of the loop's thread.
  std::unique_ptr<RecordedAnswer> answer;
  const Query* asked = nullptr;
  std::shared_ptr<const PreparedSpace> prepared;
  JointState joints;
  std::int64_t number = 0;
  double last_s = std::numeric_limits<double>::quiet_NaN();
  double elapsed_s = 0;
  double segment_s = 0;
  bool may_go_on = false;
  /// Since the last request that was recorded.
  bool has_stopped = false;
};

Recorder::Parts::Parts(RecordedCell of, RecorderSettings with)
    : cell(std::move(of)),
      settings(std::move(with)),
      tape(cell, settings),
      kept(cell.cameras.size()),
      backgrounds(cell.cameras.size()) {}

std::size_t Recorder::Parts::camera_of(const MountedCamera* mounted) const {
  for (std::size_t k = 0; k < cell.cameras.size(); ++k) {
    if (cell.cameras[k].get() == mounted) return k;
  }
  throw std::invalid_argument(fmt::format(
      "frame: of camera {}, whose MountedCamera is none of the recorder's; expected one of those",
      mounted ? mounted->mount().name : "none"));
}

void Recorder::Parts::put(KeptImage image) {
  const std::lock_guard lock(mutex);
  const std::size_t k = image->camera;
  if (image->is_background) {
    backgrounds[k] = image;
    kept[k].lose();
  }
  if (tape.put(image)) {
    if (!image->is_background) kept[k].put(std::move(image));
    return;
  }
  ++lost_images;
  is_broken = true;
  if (!image->is_background) kept[k].lose();
}

bool Recorder::Parts::are_kept(const Request& request) {
  return std::ranges::all_of(request.frames.get(), [&](const Frame* frame) {
    if (!frame || !frame->mounted) return true;
    return kept[camera_of(frame->mounted.get())].holds(frame->number);
  });
}

void Recorder::Parts::pass(const Request& request) {
  double now_s = request.now_s.value_or(std::numeric_limits<double>::quiet_NaN());
  for (const Frame* frame : request.frames.get()) {
    if (!request.now_s && frame && !(now_s >= frame->stamp_s)) now_s = frame->stamp_s;
  }
  if (!std::isfinite(now_s)) now_s = steady_now_s();
  if (now_s > last_s) elapsed_s += std::min(now_s - last_s, kMostStep_s);
  last_s = now_s;
}

bool Recorder::Parts::begins_with(const Query& query, const Request& request) {
  const std::lock_guard lock(mutex);
  const bool is_due =
      is_broken || asked != &query || elapsed_s - segment_s >= settings.seconds / kSegments;
  return is_due && tape.has_room() && are_kept(request);
}

void Recorder::Parts::lose_request() {
  ++lost_requests;
  is_broken = true;
}

bool Recorder::Parts::open(const Query& query, const Request& request, bool begins) {
  const std::lock_guard lock(mutex);
  // Much may have come since the request began.
  if (!are_kept(request) || (is_broken && !begins)) {
    ++number;
    // About frames of before the recorder: then it has not begun, and nothing is lost.
    if (asked || lost_images > 0) lose_request();
    return false;
  }
  for (const Frame* frame : request.frames.get()) {
    if (frame && frame->mounted) kept[camera_of(frame->mounted.get())].drop_before(frame->number);
  }
  answer = tape.spare_answer();
  answer->begins = begins;
  if (begins) open_segment(query);
  return true;
}

void Recorder::Parts::open_segment(const Query& query) {
  asked = &query;
  segment_s = elapsed_s;
  is_broken = false;
  answer->begin.camera_names = query.camera_names();
  answer->begin.lost_images = lost_images - told_images;
  answer->begin.lost_requests = lost_requests - told_requests;
  add_needed();
}

void Recorder::Parts::add_needed() {
  const auto add = [this](const KeptImage& image) {
    if (std::ranges::find(answer->needed, image) == answer->needed.end()) {
      answer->needed.push_back(image);
    }
  };
  for (const KeptImage& background : backgrounds) {
    if (background) add(background);
  }
  for (const KeptImages& of_camera : kept) std::ranges::for_each(of_camera.images(), add);
}

void Recorder::Parts::fill(const Request& request, const JointState* of_joints,
                           TimeStatus joints_status, const Result& result) {
  answer->time_s = last_s;
  answer->elapsed_s = elapsed_s;
  answer->is_stop = false;
  answer->result = result;
  RecordedRequest& out = answer->request;
  out.number = number++;
  out.now_s = request.now_s;
  out.X_WB = request.X_WB;
  // Memory that is there is used again.
  if (of_joints) {
    out.joints = *of_joints;
  } else {
    out.joints.reset();
  }
  out.joints_status = joints_status;
  out.frames.clear();
  for (const Frame* frame : request.frames.get()) {
    out.frames.push_back(frame && frame->mounted ? frame->number : 0);
  }
  fill_space(request.frames);
  out.is_stopped = request.stop.stop_requested();
  out.is_monitored = false;
}

void Recorder::Parts::fill_space(const NewestFrames& frames) {
  RecordedRequest& out = answer->request;
  const std::shared_ptr<const PreparedSpace>& space = frames.prepared();
  out.space = !space                                 ? RecordedRequest::Space::frames
              : space == prepared && !answer->begins ? RecordedRequest::Space::as_before
                                                     : RecordedRequest::Space::prepared;
  if (out.space == RecordedRequest::Space::prepared) {
    out.searched_for.assign(space->searched_for().begin(), space->searched_for().end());
  }
  if (space) prepared = space;
}

void Recorder::Parts::close() {
  if (!answer) return;
  const std::lock_guard lock(mutex);
  // What came since it was opened stands before it on the tape, where nobody looks any more.
  if (answer->begins) add_needed();
  // Those that it reports on, if it is taken.
  const std::int64_t of_images = answer->begins ? answer->begin.lost_images : 0;
  const std::int64_t of_requests = answer->begins ? answer->begin.lost_requests : 0;
  const bool is_stop = answer->is_stop;
  if (!tape.put(std::exchange(answer, nullptr))) {
    // The next one reports it.
    has_stopped |= is_stop;
    return lose_request();
  }
  told_images += of_images;
  told_requests += of_requests;
}

Recorder::Recorder(std::shared_ptr<const Robot> robot,
                   std::vector<std::shared_ptr<const MountedCamera>> cameras,
                   std::optional<SeparationSettings> separation, RecorderSettings settings) {
  validate(settings);
  parts_ = std::make_unique<Parts>(
      RecordedCell{std::move(robot), std::move(cameras), std::move(separation), BERTH_VERSION},
      std::move(settings));
}

Recorder::~Recorder() {
  parts_->close();
  parts_->tape.finish();
}

void Recorder::put(const Frame& frame, DepthView depth_m) {
  const std::size_t camera = parts_->camera_of(frame.mounted.get());
  require_size(frame.mounted->camera(), depth_m);
  const std::shared_ptr<RecordedImage> image = parts_->images.take();
  image->camera = camera;
  image->is_background = false;
  image->exposure.number = frame.number;
  image->exposure.time = frame.time;
  image->exposure.watch = frame.watch;
  image->exposure.X_PC = frame.X_PC;
  image->exposure.X_WB = frame.X_WB;
  image->exposure.joints = frame.joints;
  copy(depth_m, image->depth_m);
  parts_->put(image);
}

void Recorder::put_background(const MountedCamera& mounted, DepthView depth_m) {
  const std::size_t camera = parts_->camera_of(&mounted);
  require_size(mounted.camera(), depth_m);
  const std::shared_ptr<RecordedImage> image = parts_->images.take();
  image->camera = camera;
  image->is_background = true;
  image->exposure = {};
  copy(depth_m, image->depth_m);
  parts_->put(image);
}

void Recorder::push_joints(double stamp_s, std::span<const std::string> names,
                           std::span<const double> positions) {
  parts_->tape.put_joints(stamp_s, json_text(stamp_s, {names.begin(), names.end()},
                                             {positions.begin(), positions.end()}));
}

const Result& Recorder::ask(Query& query, const Request& request) {
  Parts& p = *parts_;
  p.close();
  TimeStatus joints_status = TimeStatus::ok;
  const JointState* const joints = request.joints.read(request.now_s, p.joints, joints_status);
  p.pass(request);
  const bool begins = p.begins_with(query, request);
  if (begins) query.forget();
  Request resolved = request;
  resolved.joints = joints ? RequestedJoints(*joints, joints_status) : RequestedJoints();
  const Result& result = query.ask(resolved);
  if (p.open(query, request, begins)) p.fill(request, joints, joints_status, result);
  return result;
}

const Separation& Recorder::update(SeparationMonitor& monitor, const Result& result,
                                   const PlannedMotion& motion, double now_s,
                                   const FrameSet* frames) {
  Parts& p = *parts_;
  if (!p.cell.separation) {
    throw std::invalid_argument(
        "recorder: made without a monitor's settings; expected them, to record a monitor");
  }
  const SeparationMemory before = monitor.memory();
  const Separation& separation = monitor.update(result, motion, now_s, frames);
  const bool is_stop = separation.state == SeparationState::stop;
  p.has_stopped |= is_stop && p.may_go_on;
  p.may_go_on = !is_stop;
  if (!p.answer) return separation;
  p.answer->request.is_monitored = true;
  RecordedMotion& out = p.answer->request.motion;
  out.now_s = now_s;
  out.velocity.assign(motion.velocity.begin(), motion.velocity.end());
  out.path.assign(motion.path.begin(), motion.path.end());
  out.has_frames = frames != nullptr;
  out.before = before;
  p.answer->separation = separation;
  p.answer->is_stop = std::exchange(p.has_stopped, false);
  p.close();
  return separation;
}

void Recorder::write() {
  parts_->close();
  parts_->tape.write();
}

void Recorder::finish() {
  parts_->close();
  parts_->tape.finish();
  if (const std::string trouble = counts().trouble; !trouble.empty()) {
    throw std::runtime_error(trouble);
  }
}

RecorderCounts Recorder::counts() const {
  const std::lock_guard lock(parts_->mutex);
  RecorderCounts counts = parts_->tape.counts();
  counts.lost_images += parts_->lost_images;
  counts.lost_requests += parts_->lost_requests;
  return counts;
}

}  // namespace berth
