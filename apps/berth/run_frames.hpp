// The frames of a scene, with a progress bar, and pictures of them.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
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

/// Which pictures are drawn.
struct Pictures {
  /// Empty: none.
  std::filesystem::path folder;
  /// Of each camera's image of this number; without it of each image.
  std::optional<std::size_t> image = {};
};

/// All frames of a scene through the whole pipeline, each request asked so often (SceneRun::ask):
/// `take` gets each result. Throws as SceneRun does,
/// before anything is written.
void run_frames(const OpenScene& scene, const Pictures& pictures, int repeat,
                const std::function<void(const Result&)>& take);

}  // namespace berth::app
