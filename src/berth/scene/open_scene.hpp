// A scene file and all that it names, ready to be run.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "berth/pipeline/view.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// A camera of a scene: its view of the robot, its images and the robot's joints in each of them.
struct OpenCamera {
  SceneCamera source;
  std::shared_ptr<const View> view;
  /// The joint angles when each image was exposed.
  std::vector<JointState> at_exposure;
  /// And how they were found: all NaN where this is not ok.
  std::vector<FrameTime> exposure_time;
  /// The images that were kept when they were checked; one without pixels is read again.
  std::vector<DepthImage> kept_depth_m;

  DepthImage read_depth(std::size_t frame) const;
};

struct OpenScene {
  std::filesystem::path file;
  std::shared_ptr<const Robot> robot;
  std::vector<OpenCamera> cameras;
  std::size_t frame_count = 0;  ///< of all cameras
};

/// All depth images together may keep so many bytes of memory; what is beyond is decoded twice.
inline constexpr std::size_t kMostKeptBytes = std::size_t{512} << 20;

/// Opens all that the scene names, each depth image included, so that nothing that can be known to
/// be bad is found only after results were given. A frame whose stamp the joints do not reach is no
/// error but has that status, unless all of a camera's frames are so. `before_image` is called
/// before each image is read, and ends it all by an exception. Throws std::runtime_error with file,
/// place, value and what was expected.
OpenScene open_scene(const SceneFile& scene, const std::function<void()>& before_image = [] {});

/// The same for read_scene(file).
OpenScene open_scene(const std::filesystem::path& file);

}  // namespace berth
