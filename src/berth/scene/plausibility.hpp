#pragma once

#include <string>
#include <vector>

#include "berth/scene/open_scene.hpp"
#include "berth/watch/seen_through.hpp"

namespace berth {

/// Whether the robot is where it should be in one camera's images, and if not, which simple mistake
/// in the scene would explain where it is.
struct CameraPlausibility {
  std::string camera;
  /// Nothing may be concluded from its images.
  bool is_implausible = false;
  /// Something hides the robot in all images that were looked at: nothing reports whether it is
  /// where it should be. No mistake.
  bool is_hidden = false;
  /// What was counted in the images that were looked at, and how many these are.
  RobotReadings readings;
  std::size_t frames = 0;
  /// The links that most of the readings at their pixels lie behind, as if they were not there.
  std::vector<std::string> seen_through;
  /// The fault, where the images alone show it: such as "all its readings are the same". Empty
  /// where they do not.
  std::string dead;
  /// What explains it, as SimpleMistake::cause; two with " or " between where they do so alike;
  /// empty where nothing does.
  std::string cause;
  /// SimpleMistake::place of the first of them.
  std::string place;
  /// The SimpleMistake::cause of those that explain it, are mistakes in the joints, and are
  /// contradicted by no other camera: where there are any, no camera's image may be used.
  std::vector<std::string> in_joints;
  /// The share of the robot's readings that would lie at its surface then.
  double share_then = 0;
  /// Why no pose fits the images, and with which focal length one does; empty where nobody looked
  /// for it (find_implausible() of running cameras does), or one fits.
  std::string fits_otherwise;
};

/// An explanation puts so much more of the robot's readings at its surface than the scene does.
inline constexpr double kLeastGain = 0.3;

/// Looks at some images of each camera. A camera is implausible where fewer of the robot's readings
/// than WatchSettings::min_at_robot lie at its surface, where one simple mistake explains where
/// they lie much better than the scene does, or where it is dead. One whose min_at_robot is 0 is
/// not looked at. Throws std::runtime_error where an image cannot be read again.
std::vector<CameraPlausibility> find_implausible(const OpenScene& scene);

/// The same for those who use the images. Throws std::runtime_error where no camera is left, and
/// where the joints are wrong: then the other cameras look for the robot in the wrong place, too,
/// even if they do not see enough of it to tell.
std::vector<CameraPlausibility> require_plausible(const OpenScene& scene);

/// The same of one camera.
CameraPlausibility find_implausible(const OpenScene& scene, std::size_t camera);

/// Where a smaller share of the robot's readings lies at its surface, something is wrong in the
/// scene, though nobody knows what.
inline constexpr double kWellPlaced = 0.85;

/// The doubts about images that are used: too little of the robot to check anything, a share below
/// kWellPlaced, links that are not there. Empty where there is none.
std::string doubt_of(const CameraPlausibility& camera);

/// One sentence or two for people: which camera, what share, what was expected, what would explain
/// it, or the doubt. Empty where there is nothing to say.
std::string text_of(const CameraPlausibility& camera);
/// The same without "camera NAME: ", for where that stands already, and without doubts.
std::string text_without_name(const CameraPlausibility& camera);

}  // namespace berth
