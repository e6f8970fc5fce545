#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "apps/berth/frame_pipeline.hpp"
#include "apps/berth/open_scene.hpp"
#include "berth/io/frame_result.hpp"

namespace berth {

/// Several cameras have a folder each below `folder`.
std::filesystem::path folder_of(const OpenScene& scene, const OpenCamera& camera,
                                const std::filesystem::path& folder);

/// Makes the folders of all cameras. Throws std::runtime_error where one cannot be made.
void make_folders(const OpenScene& scene, const std::filesystem::path& folder);

/// One for each camera. Throws std::runtime_error where the scene's settings do not go with the
/// backend.
std::vector<std::unique_ptr<FramePipeline>> open_pipelines(const OpenScene& scene,
                                                           app::Backend backend);

/// All images of a camera, one after another: `take` gets the frame's number and the image when the
/// pipeline has observed it. Where the scene asks for a background, that is learned from all of
/// them first.
void observe_frames(const OpenCamera& camera, FramePipeline& pipeline,
                    const std::function<void(std::size_t, DepthView)>& take);

/// All frames of a scene through the whole pipeline, with a progress bar on a terminal: `take` gets
/// each result, camera by camera. Each frame is drawn into picture_folder unless that is empty.
/// Throws as open_context and open_pipelines do, before anything is written.
void run_frames(const OpenScene& scene, const app::BackendArguments& where,
                const std::filesystem::path& picture_folder,
                const std::function<void(const FrameResult&)>& take);

}  // namespace berth
