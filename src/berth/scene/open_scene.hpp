// A scene file and all that it names, ready to be run.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/scene/scene_file.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// A camera of a scene: its view of the robot, its images and the robot's joints in each of them.
struct OpenCamera {
  SceneCamera source;
  std::shared_ptr<const MountedCamera> mounted;
  /// The joint angles when each image was exposed.
  std::vector<JointState> at_exposure;
  /// And how they were found: all NaN where this is not ok.
  std::vector<FrameTime> exposure_time;
  /// The images that are kept in memory; a null one is decoded where it is asked for. Scenes that
  /// differ in their settings share them.
  std::vector<std::shared_ptr<const DepthImage>> kept_depth_m;
  /// That of the scene file; none where it is learned, or the rule is off.
  std::optional<DepthImage> background_m;
  /// None where the images are those of the pinhole camera.
  std::shared_ptr<const Rectification> rectification;

  /// The camera as the files have it, which `view` has rectified.
  const Camera& given() const { return rectification ? rectification->given() : mounted->camera(); }
  /// In metres, rectified. Throws std::runtime_error where the image cannot be decoded.
  DepthImage read_depth(std::size_t frame) const;
  /// The same as the camera gave it.
  DepthImage read_given(std::size_t frame) const;
  /// The same from its file, with readings that near_m and far_m leave out.
  DepthImage read_all_depth(std::size_t frame) const;
};

/// Whether what gives no reading is told, or somebody has said what that means.
bool tells_unread(const OpenCamera& camera);

/// A scene whose files were all read and checked.
struct OpenScene {
  std::filesystem::path file;
  /// SceneFile::warnings, and those that need the cameras' intrinsics.
  std::vector<std::string> warnings;
  std::shared_ptr<const Robot> robot;
  /// With the file's offsets in them.
  std::shared_ptr<const JointTrajectory> joints;
  std::map<std::string, double> joint_offsets;
  std::vector<OpenCamera> cameras;
  std::size_t frame_count = 0;  ///< of all cameras
  /// None: nothing is monitored.
  std::optional<SeparationSettings> separation;
};

/// What the scene's `attached:` describes, with its meshes. Throws std::runtime_error as
/// read_mesh_file does.
std::vector<Attachment> attachments_of(const SceneFile& scene);

/// Images are kept in memory up to this number of bytes in all; the rest is decoded each time.
inline constexpr std::size_t kMostKeptBytes = std::size_t{512} << 20;

/// Opens all that the scene names. Both ends of each depth image are looked at, so that one that is
/// missing, cut off, or of another kind or size is found before the first result; what is damaged
/// in between is found by read_depth(). No image is kept. A frame whose stamp lies outside of the
/// joints' times is no error: it has that status. It is one if that holds for all frames of a
/// camera. `before_image` is called before each image; to stop, it throws. Throws
/// std::runtime_error with file, place, value and what was expected.
OpenScene open_scene(
    const SceneFile& scene, const std::function<void()>& before_image = [] {});

/// The same for read_scene(file).
OpenScene open_scene(const std::filesystem::path& file);

/// The same, where each image is decoded and the first ones are kept, up to kMostKeptBytes: for who
/// goes through them again and again.
OpenScene open_scene_with_images(
    const SceneFile& scene, const std::function<void()>& before_image = [] {});

/// open_scene(changed) where `changed` differs from the file of `before` in settings of requests
/// and cameras, in poses, clocks and joint offsets alone: robot and images are those of `before`,
/// so that it takes a moment. The robot has `carried` on it besides what the file names, and
/// nothing else; each that `before` has on it as well has to be the same. Throws as open_scene
/// does.
OpenScene reopen_scene(const OpenScene& before, const SceneFile& changed,
                       const std::vector<Attachment>& carried = {});

}  // namespace berth
