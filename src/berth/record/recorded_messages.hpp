// Inside record/ only: what a recording holds, message by message.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/record/mcap_file.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

struct RecordedCell;

/// The channels of a recording; those of camera k follow from kCameraChannel + k * kCameraChannels
/// on.
enum : std::uint16_t {
  kBeginChannel = 1,
  kRequestChannel = 2,
  kResultChannel = 3,
  kJointsChannel = 4,
  kCameraChannel = 8,
};
enum : std::uint16_t { kExposureOfCamera, kDepthOfCamera, kBackgroundOfCamera, kCameraChannels };

inline std::uint16_t channel_of(std::size_t camera, std::uint16_t which) {
  return static_cast<std::uint16_t>(kCameraChannel + camera * kCameraChannels + which);
}

/// All but messages, of a recording of this cell.
mcap::Head head_of(const RecordedCell& cell);

/// A message's time: 0 for one that is before that, or no number.
std::uint64_t time_ns(double time_s);

/// From here on requests follow from what the file has: they know nothing of those before.
struct RecordedBegin {
  /// Query::camera_names().
  std::vector<std::string> camera_names;
  /// Images that are missing since the request before, because the disk was too slow.
  std::int64_t lost_images = 0;
  std::int64_t lost_requests = 0;
};

/// What Observer::observe() made a frame of, but for the image, and what its watch said.
struct RecordedExposure {
  std::uint64_t number = 0;
  FrameTime time;
  CameraWatch watch;
  Pose X_PC = Pose::Identity();
  Pose X_WB = Pose::Identity();
  JointState joints;
};

/// What a monitor was asked with.
struct RecordedMotion {
  double now_s = 0;
  std::vector<double> velocity;
  std::vector<JointState> path;
  bool has_frames = false;
  SeparationMemory before;
};

/// A request; look-ahead is not in it.
struct RecordedRequest {
  /// Counted from 0, with those that are lost.
  std::int64_t number = 0;
  std::optional<double> now_s;
  std::optional<Pose> X_WB;
  /// None: those of the exposure.
  std::optional<JointState> joints;
  TimeStatus joints_status = TimeStatus::ok;
  /// RecordedExposure::number of each camera's frame; 0: none.
  std::vector<std::uint64_t> frames;
  enum class Space { frames, prepared, as_before } space = Space::frames;
  /// PreparedSpace::searched_for(), where `space` is prepared.
  std::vector<JointState> searched_for;
  /// It was asked to stop early.
  bool is_stopped = false;
  bool is_monitored = false;
  /// Where it is monitored.
  RecordedMotion motion;
};

std::string json_text(const RecordedBegin& begin);
std::string json_text(const RecordedExposure& exposure);
std::string json_text(const RecordedRequest& request);
/// A joint message as it came.
std::string json_text(double stamp_s, const std::vector<std::string>& names,
                      const std::vector<double>& positions);

/// Back from these texts. Each throws std::exception where the text is none.
RecordedBegin begin_of(std::string_view text);
RecordedExposure exposure_of(std::string_view text);
RecordedRequest request_of(std::string_view text);

}  // namespace berth
