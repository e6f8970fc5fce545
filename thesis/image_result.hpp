// What one camera's images tell of the links.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/query.hpp"
#include "thesis/link_distance.hpp"
#include "thesis/method.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// What two images tell of a link's closest pair besides (Hirt 2.10 to 2.14).
struct ImagePair {
  Pixel robot_pixel;
  /// Pixels of the link in the image of the robot.
  int robot_pixels = 0;
};

/// What a request about two images gives: distances to readings of one camera. A link that the
/// camera does not see is LinkStatus::not_visible. Nothing is told of visibility.
struct ImageResult : Result {
  Method method = Method::exact;
  /// The OpenGL renderer, where a part was computed on it.
  std::string gl_renderer;
  /// Whether lower bounds say more than the distances.
  bool has_bounds = false;
  /// pairs_of[i] is of links[i].
  std::vector<ImagePair> pairs_of;
  /// Pair distances that were computed (the thesis plots it).
  std::int64_t pairs = 0;
};

/// What requests about images are asked with: the robot's own settings, and the method's.
ImageDistanceSettings settings_of(const Robot& robot, const ImageSettings& images);

/// Whether a search with these settings may end before its bounds are the distances.
bool may_end_early(const DistanceSettings& settings);

/// A result of this robot and method about which nothing is known yet.
ImageResult empty_image_result(const Robot& robot, Method method, const ImageSettings& images);

/// The first step of each request: writes stamps, time and camera, and withholds what the request
/// before told. Whether the exposure allows a result for joints of this stamp (none: those of the
/// exposure) with this status; `state` is what becomes of its camera.
bool begin_image_result(const Robot& robot, const Exposure& exposure, const CameraState& state,
                        std::optional<double> joints_stamp_s, TimeStatus joints_status,
                        std::optional<double> now_s, ImageResult& out);

/// The last step: `X_BC` is the camera's pose.
void tell_image_distances(const LinkDistances& distances, const Pose& X_BC, ImageResult& out);

}  // namespace berth
