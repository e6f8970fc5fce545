#include "berth/record/replay.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "berth/pipeline/frame_pool.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/prepared_space.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/record/depth_message.hpp"
#include "berth/record/mcap_reader.hpp"
#include "berth/record/recorded_cell.hpp"
#include "berth/record/recorded_messages.hpp"
#include "berth/results/result_json.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {
namespace {

/// Does once more what was recorded, in its order, in one thread.
class ReplayedCell {
 public:
  /// `cell` outlives it.
  explicit ReplayedCell(const RecordedCell& cell);

  /// Knows nothing any more of what was before.
  void begin(const RecordedBegin& begin);
  void set_background(std::size_t camera, DepthView depth_m);
  void observe(std::size_t camera, const RecordedExposure& exposure, DepthView depth_m);
  /// Throws std::runtime_error for a frame that was not observed.
  Result ask(const RecordedRequest& request);

 private:
  std::vector<std::shared_ptr<const Frame>> frames_of(const RecordedRequest& request);
  NewestFrames newest_of(const RecordedRequest& request,
                         const std::vector<std::shared_ptr<const Frame>>& frames);
  Separation update(const RecordedMotion& motion, const Result& result);

  const RecordedCell& cell_;
  std::vector<Observer> observers_;
  FramePool pool_;
  /// Of each camera, by number.
  std::vector<std::map<std::uint64_t, std::shared_ptr<const Frame>>> frames_;
  /// What the query was asked about last; it does not hold frames itself.
  std::vector<std::shared_ptr<const Frame>> asked_;
  std::shared_ptr<const PreparedSpace> prepared_;
  std::optional<Query> query_;
  std::optional<SeparationMonitor> monitor_;
};

/// What the watch said is in the recording.
std::optional<double> measure_nothing(DepthView, const JointState&, const Pose&,
                                      const std::stop_token&) {
  return std::nullopt;
}

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

using Json = nlohmann::ordered_json;

/// Such as "[arm_link_3]" for a link's part in a list, else "[2]".
std::string place_text(const Json& element, std::size_t i) {
  for (const char* name : {"link", "camera"}) {
    if (element.is_object() && element.contains(name) && element[name].is_string()) {
      return fmt::format("[{}]", element[name].get<std::string>());
    }
  }
  return fmt::format("[{}]", i);
}

std::optional<ReplayDifference> compare(const std::string& field, const Json& a, const Json& b) {
  if (a == b && a.dump() == b.dump()) return std::nullopt;
  if (a.is_object() && b.is_object()) {
    const std::string before = field.empty() ? "" : field + ".";
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key)) return ReplayDifference{before + key, value.dump(), "nothing"};
      if (const auto found = compare(before + key, value, b[key])) return found;
    }
    for (const auto& [key, value] : b.items()) {
      if (!a.contains(key)) return ReplayDifference{before + key, "nothing", value.dump()};
    }
  }
  if (a.is_array() && b.is_array() && a.size() == b.size()) {
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (const auto found = compare(field + place_text(a[i], i), a[i], b[i])) return found;
    }
  }
  return ReplayDifference{field, a.dump(), b.dump()};
}

/// The first field in which two results differ, as JSON; none where they are equal to the last bit.
/// Throws std::exception where one is no JSON.
std::optional<ReplayDifference> first_difference(const std::string& recorded,
                                                 const std::string& replayed) {
  if (recorded == replayed) return std::nullopt;
  return compare("", Json::parse(recorded), Json::parse(replayed));
}

}  // namespace

struct Replay::Parts {
  explicit Parts(const std::filesystem::path& path)
      : file(path), cell(read_cell(file)), again(cell), exposures(cell.cameras.size()) {}

  /// Whether it completes a request.
  bool take(const mcap::Message& message);
  void take_image(std::size_t camera, std::uint16_t which, std::string_view data);
  void ask(std::string_view recorded_result);

  mcap::FileReader file;
  RecordedCell cell;
  ReplayedCell again;
  /// Those whose image follows.
  std::vector<std::optional<RecordedExposure>> exposures;
  std::optional<RecordedRequest> request;
  RecordedBegin begin;
  /// Of the request before; none: there was none.
  std::optional<std::int64_t> number_before;
  std::int64_t number = 0;
  double time_s = 0;
  Result result;
  std::string recorded;
  std::optional<ReplayDifference> difference;
  bool is_stopped = false;
};

void Replay::Parts::take_image(std::size_t camera, std::uint16_t which, std::string_view data) {
  if (which == kExposureOfCamera) {
    exposures[camera] = exposure_of(data);
    return;
  }
  const DepthImage depth_m = depth_of_message(data);
  if (which == kBackgroundOfCamera) return again.set_background(camera, depth_m);
  if (!exposures[camera]) throw std::runtime_error("an image without its exposure");
  again.observe(camera, *exposures[camera], depth_m);
  exposures[camera].reset();
}

void Replay::Parts::ask(std::string_view recorded_result) {
  if (!request) throw std::runtime_error("a result without its request");
  number = request->number;
  const std::int64_t next = number_before.value_or(number) + 1 + begin.lost_requests;
  if (number_before && number != next) {
    throw std::runtime_error(fmt::format("request {} follows request {}; expected request {}",
                                         number, *number_before, next));
  }
  number_before = number;
  is_stopped = request->is_stopped;
  result = again.ask(*request);
  recorded = recorded_result;
  difference = first_difference(recorded, result_json(result));
  request.reset();
}

bool Replay::Parts::take(const mcap::Message& message) {
  if (message.channel == kBeginChannel) {
    begin = begin_of(message.data);
    again.begin(begin);
  } else if (message.channel == kRequestChannel) {
    if (request) throw std::runtime_error(fmt::format("request {} has no result", request->number));
    request = request_of(message.data);
  } else if (message.channel == kResultChannel) {
    ask(message.data);
    return true;
  } else if (message.channel >= kCameraChannel) {
    const auto which = static_cast<std::uint16_t>(message.channel - kCameraChannel);
    const std::size_t camera = which / kCameraChannels;
    if (camera < exposures.size()) take_image(camera, which % kCameraChannels, message.data);
  }
  return false;
}

Replay::Replay(const std::filesystem::path& file) : parts_(std::make_unique<Parts>(file)) {}
Replay::~Replay() = default;

bool Replay::next() {
  Parts& p = *parts_;
  p.begin = {};
  mcap::Message message;
  while (p.file.next(message)) {
    try {
      p.time_s = static_cast<double>(message.time_ns) / 1e9;
      if (p.take(message)) return true;
    } catch (const std::exception& error) {
      p.file.fail_with(fmt::format("at {:.3f} s", p.time_s), error.what());
    }
  }
  if (p.request) p.file.fail_with(fmt::format("request {}", p.request->number), "has no result");
  if (!p.number_before) p.file.fail("no request is in it", "one at least");
  return false;
}

std::int64_t Replay::number() const { return parts_->number; }
double Replay::time_s() const { return parts_->time_s; }
const Result& Replay::result() const { return parts_->result; }
const std::string& Replay::recorded() const { return parts_->recorded; }
const std::optional<ReplayDifference>& Replay::difference() const { return parts_->difference; }
std::int64_t Replay::lost_images() const { return parts_->begin.lost_images; }
std::int64_t Replay::lost_requests() const { return parts_->begin.lost_requests; }

std::string Replay::text() const {
  const Parts& p = *parts_;
  if (!p.difference) return "";
  std::string text =
      fmt::format("request {}, {:.3f} s: {}: recorded {}, replayed {}", p.number, p.time_s,
                  p.difference->field, p.difference->recorded, p.difference->replayed);
  if (p.cell.version != BERTH_VERSION) {
    text += fmt::format("; recorded by berth {}, replayed by {}", p.cell.version, BERTH_VERSION);
  }
  if (p.is_stopped) text += "; it was stopped early, and what that cut short is not found again";
  if (p.cell.had_deadline) {
    text += "; it had a deadline (deadline_us), and what that cut short is not found again";
  }
  return text;
}

ReplaySummary replay(const std::filesystem::path& file) {
  ReplaySummary summary;
  for (Replay again(file); again.next();) {
    ++summary.requests;
    summary.lost_images += again.lost_images();
    summary.lost_requests += again.lost_requests();
    if (!again.difference()) continue;
    if (summary.different++ == 0) summary.first_difference = again.text();
  }
  return summary;
}

}  // namespace berth
