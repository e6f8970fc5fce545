#pragma once

#include <filesystem>
#include <memory>

#include "apps/berth/open_scene.hpp"
#include "bench/bench_scene.hpp"

namespace berth::bench {

/// A scene file, opened; what its first camera saw.
struct Recording {
  std::string title;
  OpenScene scene;

  const OpenCamera& camera() const { return scene.cameras.front(); }
};

/// Answers go without visibility, which no peer tells. Throws as open_scene does.
std::shared_ptr<const Recording> open_recording(const std::filesystem::path& file,
                                                std::string title);

/// Up to max_count of its frames, spread over the recording, after berth's own self filter.
SceneSet recorded_scenes(std::shared_ptr<const Recording> recording, int max_count);

}  // namespace berth::bench
