// What T, and T and D together, say of cameras that were bumped, and of cameras that were not while
// somebody hides the robot: one second at 30 Hz of each.
#pragma once

#include <vector>

#include "berth/scene/open_scene.hpp"
#include "berth/watch/watch_settings.hpp"

namespace berth::lab {

/// From the first frame after the bump.
inline constexpr int kFramesPerSecond = 30;

/// T of frames that follow each other; NaN where a frame says nothing.
using SeenThroughs = std::vector<double>;

/// Of the camera's own frames, as it stands.
SeenThroughs own_frames(const OpenCamera& camera);

/// D of frames, in m; NaN where a frame says nothing.
using Displacements = std::vector<double>;

/// Of every `nth` of the camera's own frames.
Displacements own_displacements(const OpenCamera& camera, int nth);

/// How a camera is moved about its optical centre; each in 14 directions, which are the middles of
/// a cube's faces and its corners.
struct Bump {
  double offset_m = 0;
  double angle_rad = 0;
};
inline constexpr int kDirections = 14;

/// One second each: every `nth` of the camera's frames with 30 draws of noise (1.5 mm at 1 m,
/// growing with z², and 1 % without a reading), and each direction of the bump.
std::vector<SeenThroughs> bumped_seconds(const OpenCamera& camera, const Bump& bump, int nth);

/// One second each, the same with noise: somebody stands before the robot and hides up to 90 % of
/// it, and the camera stands as it should.
std::vector<SeenThroughs> hidden_seconds(const OpenCamera& camera, int draws);

/// Seconds with an alarm, of T or D, of all.
struct AlarmCount {
  int alarms = 0;
  int seconds = 0;
};

/// The whole watch in the same seconds.
AlarmCount bumped_alarms(const OpenCamera& camera, const Bump& bump, int nth,
                         const WatchSettings& rule);
AlarmCount hidden_alarms(const OpenCamera& camera, int draws, const WatchSettings& rule);

/// Whether this rule (WatchSettings) raises an alarm in these frames.
bool is_alarm(const SeenThroughs& frames, const WatchSettings& rule);

/// The share of the seconds with an alarm.
double alarm_share(const std::vector<SeenThroughs>& seconds, const WatchSettings& rule);

}  // namespace berth::lab
