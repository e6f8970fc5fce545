// What `berth doctor` looks at: each check asks what berth knows anyway, and says what to do next.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "berth/scene/open_scene.hpp"

namespace berth::app {

enum class Verdict {
  ok,
  advice,  ///< nothing is wrong, but something could be better
  wrong,
};

/// What one check found.
struct Finding {
  Verdict verdict = Verdict::ok;
  /// One word or two: what was looked at.
  std::string about = {};
  /// What was found, a line or more.
  std::string text = {};
  /// What to do next; empty where there is nothing to do.
  std::string next = {};
};

/// Called now and then; to stop, it throws.
using Pause = std::function<void()>;

/// Each image decoded.
Finding check_images(const OpenScene& scene, const Pause& pause);
/// Whether each image has joints, and follows the one before.
std::vector<Finding> check_stamps(const OpenScene& scene);
/// Whether the robot is where it should be in some images of each camera, and what simple mistake
/// explains where it is.
std::vector<Finding> check_poses(const OpenScene& scene);
/// Whether each camera reports what gives no reading.
std::vector<Finding> check_unread(const OpenScene& scene);
/// How much of the space that the robot moves in is in no camera's first image.
Finding check_views(const OpenScene& scene);
/// Whether anybody notices a bumped camera.
std::vector<Finding> check_watch(const OpenScene& scene);
/// Results of some images: cameras that drop out, links that nobody sees, a monitor's stops.
std::vector<Finding> check_results(const OpenScene& scene, const Pause& pause);
/// The pairs of links that `known` leaves out, by reason.
Finding check_known(const OpenScene& scene);
/// The smallest things that the cameras show, and settings of the filter that would fit better.
std::vector<Finding> check_detection(const OpenScene& scene);
/// From one image to the next; NaN where the camera has no two stamps.
double period_ms(const OpenCamera& camera);
/// Whether this machine keeps up with the cameras.
std::vector<Finding> check_time(const OpenScene& scene, const Pause& pause);
/// What the scene says of separation.
Finding check_separation(const OpenScene& scene);

}  // namespace berth::app
