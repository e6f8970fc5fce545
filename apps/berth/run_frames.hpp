#pragma once

#include <filesystem>
#include <functional>

#include "apps/berth/open_scene.hpp"
#include "berth/io/frame_result.hpp"
#include "berth/pipeline/observer.hpp"

namespace berth {

/// Several cameras have a folder each below `folder`.
std::filesystem::path folder_of(const OpenScene& scene, const OpenCamera& camera,
                                const std::filesystem::path& folder);

/// Makes the folders of all cameras. Throws std::runtime_error where one cannot be made.
void make_folders(const OpenScene& scene, const std::filesystem::path& folder);

/// Where the scene asks for a background, lets the observer learn it from all images of its camera,
/// with a progress bar on a terminal.
void learn_background(const OpenCamera& camera, Observer& observer);

/// All frames of a scene through the whole pipeline, with a progress bar on a terminal: `take` gets
/// each result, camera by camera. Each frame is drawn into picture_folder unless that is empty.
void run_frames(const OpenScene& scene, const std::filesystem::path& picture_folder,
                const std::function<void(const FrameResult&)>& take);

}  // namespace berth
