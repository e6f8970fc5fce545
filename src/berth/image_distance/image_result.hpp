// What one camera's images tell of the links, as a Result.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "berth/image_distance/image_visibility.hpp"
#include "berth/image_distance/method.hpp"
#include "berth/image_distance/rejected_distances.hpp"
#include "berth/image_distance/settings.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/types/link_distance.hpp"

namespace berth {

/// What requests about images are asked with: the robot's own settings, and the method's.
ImageDistanceSettings settings_of(const Robot& robot, const ImageSettings& images);

/// A result of this robot and method about which nothing is known yet.
Result empty_image_result(const Robot& robot, Method method, const ImageSettings& images);

/// The first step of each request: writes stamps, time and camera, and withholds what the request
/// before told. Whether the exposure allows a result for joints of this stamp (none: those of the
/// exposure) with this status; `state` is what becomes of its camera.
bool begin_image_result(const Robot& robot, const Exposure& exposure, const CameraState& state,
                        std::optional<double> joints_stamp_s, TimeStatus joints_status,
                        std::optional<double> now_s, Result& out);

/// The last step but visibility: `X_BC` is the camera's pose.
void tell_image_distances(const LinkDistances& distances, const Pose& X_BC, Result& out);

/// The memory of tell_image_visibility(), one for each thread.
struct TellWorkspace {
  VisibilityWorkspace visibility;
  RejectedWorkspace rejected;
  SearchableDepth rejected_depth;
  /// Of which exposure it is; at first of none.
  std::uint64_t rejected_number = std::numeric_limits<std::uint64_t>::max();
  std::vector<LinkVisibility> links;
};

/// Fills the visibility where the settings ask for it. `asked` is what `distances` are about.
void tell_image_visibility(const Robot& robot, const Frame& frame, const AskedRobot& asked,
                           const LinkDistances& distances, TellWorkspace& workspace, Result& out);

}  // namespace berth
