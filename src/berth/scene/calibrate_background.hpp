// Calibration's frames, as the backgrounds that a scene begins with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "berth/scene/open_scene.hpp"
#include "berth/scene/rewrite_scene.hpp"

namespace berth {

/// What a fixed camera sees where the robot is not.
struct CalibratedBackground {
  std::string camera;  ///< its name
  std::filesystem::path file;
  /// In whole millimetres, rounded down; NaN where it is not known.
  DepthImage depth_m;

  /// Of all pixels.
  double known_share() const;
};

/// NEW.background.CAMERA.png beside NEW.yaml.
std::filesystem::path background_file(const std::filesystem::path& new_file,
                                      const std::string& camera);

/// Those of a scene's cameras.
struct CalibratedBackgrounds {
  std::vector<CalibratedBackground> learned;
  /// A sentence for each camera that has none: it moves with the robot, too few images agree, or
  /// the file would be one that the scene itself names, or lie among depth images.
  std::vector<std::string> without;
};

/// Learns from all images of each fixed camera of the scene with `change`, as SceneRun does, and
/// adds to `change` what the new scene says of it: the file, and `sensor.background_frames` (3)
/// where the scene has none. `pause` is called before each image. Throws as rewritten_scene and
/// open_scene do. Writes nothing.
CalibratedBackgrounds calibrate_backgrounds(const OpenScene& scene,
                                            const std::filesystem::path& new_file,
                                            const std::function<void()>& pause,
                                            SceneChange& change);

/// Each file is complete afterwards, or as it was before. Throws std::runtime_error where one
/// cannot be written.
void write_backgrounds(const std::vector<CalibratedBackground>& backgrounds);

}  // namespace berth
