// The frames of a scene, with a progress bar, and pictures of them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/berth/arguments.hpp"
#include "apps/support/interrupt.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {

/// open_scene() or open_scene_with_images().
using OpenSceneFile = OpenScene (*)(const SceneFile& scene,
                                    const std::function<void()>& before_image);

/// The scene, with a progress bar for its images. Throws as `open` does, and Interrupted.
OpenScene open_with_progress(const SceneFile& scene, const char* doing, OpenSceneFile open);

/// The same, checked alone, with the arguments over what its file says.
/// Throws as open_scene does, and Interrupted.
OpenScene open_scene_over(const std::filesystem::path& file, const EvaluationArguments& arguments);

/// Several cameras have a folder each below `folder`.
std::filesystem::path folder_of(const OpenScene& scene, const OpenCamera& camera,
                                const std::filesystem::path& folder);

/// Makes the folders of all cameras. Throws std::runtime_error where one cannot be made.
void make_folders(const OpenScene& scene, const std::filesystem::path& folder);

/// Says what is doubtful in the scene and its `cameras`. Calls `take` after each image that `next`
/// has observed, with a progress bar on a terminal. Where that ends before the last one, what is
/// thrown says after how many images.
void each_frame(const OpenScene& scene, const std::vector<CameraPlausibility>& cameras,
                const char* doing, const std::function<bool()>& next,
                const std::function<void()>& take);
void each_frame(const OpenScene& scene, SceneRun& run, const char* doing,
                const std::function<void()>& take);

struct WantedFrames {
  /// Of pictures, which are named by the number of their result. Empty: none.
  std::filesystem::path folder;
  /// The only result that is wanted, drawn in the newest image of each camera; without it each
  /// result is, drawn in the image that it comes with.
  std::optional<std::size_t> only = {};
};

/// The frames of a scene through the whole pipeline, each request asked so often (SceneRun::ask):
/// `take` gets each result that is wanted. Throws as SceneRun does,
/// before anything is written.
void run_frames(const OpenScene& scene, const WantedFrames& wanted, int repeat,
                const std::function<void(const Result&)>& take);

/// Which of a scene's results has the least distance.
class ClosestApproach {
 public:
  /// Whether it is nearer than all before.
  bool update(const Result& result);
  /// Such as "The closest approach in 101 images is in frame 48, 1.713 s: arm_link_7, 0.015 m".
  std::string text(const OpenScene& scene) const;

 private:
  std::optional<float> least_m_;
  std::string where_;
};

}  // namespace berth::app
