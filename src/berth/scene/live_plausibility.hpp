// Whether running cameras see the robot where it should be, and if not, what would explain that.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// One image, NaN where there is no reading, and the joints at its exposure.
struct LiveImage {
  std::shared_ptr<const DepthImage> depth_m;
  JointState at_exposure;
};

/// Some images of one camera, one after another, and how they are believed to be.
struct LiveImages {
  std::shared_ptr<const MountedCamera> mounted;
  /// The unit of its images, for what is told.
  double depth_scale_m = 0.001;
  std::vector<LiveImage> images;
};

/// A focal length is judged where a camera has images of at least this number of poses.
inline constexpr std::size_t kLeastPosesForFocalLength = 5;

/// The same as find_implausible() of a scene, for all cameras of one robot. More than a scene's
/// run, it reports a focal length that is wrong by less than a quarter: where a camera's images fit
/// no pose but one from which its depth would be wrong, or fit none well, and fit with another
/// focal length, it is implausible. In the calling thread alone; takes a second or so for each
/// camera, and some where there is another focal length. `pause` is called now and then; to stop,
/// it throws.
std::vector<CameraPlausibility> find_implausible(
    const std::vector<LiveImages>& cameras, const std::function<void()>& pause = [] {});

}  // namespace berth
