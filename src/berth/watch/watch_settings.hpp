#pragma once

#include <span>

#include "berth/types/setting.hpp"

namespace berth {

/// When a camera counts as implausible, and when as moved. The latter is off by default: what is
/// normal is learnt from frames of the camera as it is meant to stand (learned_limits), by
/// calibration.
struct WatchSettings {
  /// A frame in which a smaller share of the robot's readings lies at its surface
  /// (RobotReadings::at_robot) speaks for an implausible camera; 0 is off. The default lies in the
  /// middle between good scenes and mistakes (figures in docs/calibration.md).
  double min_at_robot = 0.02;
  /// Whether frames of such a camera are used all the same, with a status that says so: for
  /// images that a program makes up.
  bool tell_only = false;
  /// T of a frame (RobotReadings::seen_through) above this speaks for a camera that moved; 0 is
  /// off.
  double max_seen_through = 0;
  /// D of a frame (MeasureDisplacement) above this does too; 0 is off.
  double max_displacement_m = 0;
  /// How far readings of the robot lie behind its surface while all is well, in the median: an
  /// error of the camera's depth, not of its place.
  double bias_m = 0;
  /// `agreeing_frames` of the last `frames` have to agree, for a camera to count as moved by T, and
  /// to count as back in its place.
  int agreeing_frames = 10;
  int frames = 15;
  /// D is measured in the background, at most once in this time of the frames' stamps. Two of the
  /// last three have to agree.
  double check_every_s = 0.4;

  /// Whether it is watched for bumps.
  bool is_on() const { return max_seen_through > 0 || max_displacement_m > 0; }
};

/// The list of these settings.
template <SettingsOf<WatchSettings> Settings, class Visitor>
void visit_settings(Settings& s, Visitor&& visit) {
  visit(
      {"min_at_robot",
       {.most = 1},
       "a camera is implausible where a smaller share of the robot's readings lies within 5 cm of "
       "its surface, or where one simple mistake explains where they lie; 0 is off"},
      s.min_at_robot);
  visit({"tell_only",
         {},
         "whether the images of an implausible camera are used all the same: then its status is "
         "unconfirmed"},
        s.tell_only);
  visit({"max_seen_through",
         {.most = 1},
         "a camera counts as moved where a larger share of the robot's readings lies 5 cm or more "
         "behind its surface; 0 is off"},
        s.max_seen_through);
  visit({"max_displacement_m", kNotNegative,
         "a camera counts as moved where the robot fits the image better when it is moved by more "
         "than this; 0 is off"},
        s.max_displacement_m);
  visit({"bias_m",
         {.least = -0.1, .most = 0.1},
         "how far readings of the robot lie behind its surface while the camera stands well"},
        s.bias_m);
}

/// Throws std::invalid_argument that names key, value and what was expected.
void validate(const WatchSettings& settings);

/// The limits of a camera for which T and D were these in frames taken as it is meant to stand, NaN
/// where a frame did not tell; off where none told. They are above what was seen by a factor, and
/// never so low that a person before the arm raises an alarm (figures in
/// tests/watch/bumped_test.cpp).
WatchSettings learned_limits(std::span<const double> seen_through,
                             std::span<const double> displacement_m);

}  // namespace berth
