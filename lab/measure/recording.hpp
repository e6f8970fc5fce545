#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "berth/scene/open_scene.hpp"

namespace berth::lab {

/// A scene file, opened; what its first camera saw.
struct Recording {
  std::string title;
  OpenScene scene;

  const OpenCamera& camera() const { return scene.cameras.front(); }
  int frame_count() const { return static_cast<int>(camera().source.depth.size()); }
  /// The frame of sample i of `count`, which lie evenly over the recording.
  std::size_t sampled_frame(int i, int count) const {
    return static_cast<std::size_t>(i) * frame_count() / count;
  }
};

/// Answers go without visibility, which nothing that is measured beside them has. Throws as
/// open_scene does.
std::shared_ptr<const Recording> open_recording(const std::filesystem::path& file,
                                                std::string title);

/// A title for one that has none: the name of the folder that the scene file stands in.
std::string recording_title(const std::filesystem::path& scene_file);

}  // namespace berth::lab
