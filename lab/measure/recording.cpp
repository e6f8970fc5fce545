#include "lab/measure/recording.hpp"

namespace berth::lab {

std::shared_ptr<const Recording> open_recording(const std::filesystem::path& file,
                                                std::string title) {
  SceneFile scene = read_scene(file);
  scene.evaluation.visibility = false;
  return std::make_shared<const Recording>(Recording{std::move(title), open_scene(scene)});
}

std::string recording_title(const std::filesystem::path& scene_file) {
  return "Recording " + std::filesystem::absolute(scene_file).parent_path().filename().string();
}

}  // namespace berth::lab
