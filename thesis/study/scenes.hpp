// What the experiments are made on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lab/measure/recording.hpp"
#include "sim/random_images.hpp"

namespace berth::lab {

/// Each enumerator is its own name.
enum class SceneKind {
  bundled,     ///< the scene that comes with berth: an arm on a table, like the thesis's
  drawn,       ///< the same arm in a random pose among random obstacles, by seed
  recording,   ///< a scene file of the user's
  worst_case,  ///< every pixel an obstacle, the robot behind every pixel (Hirt figure 3.19)
};

std::string_view name_of(SceneKind kind);

/// A scene by its name; its images are made when they are needed.
struct StudyScene {
  std::string name;
  SceneKind kind;
  std::function<sim::ImagePair()> make;
};

/// The recording's frame in the middle, after the self filter.
StudyScene recorded_scene(std::shared_ptr<const Recording> recording, SceneKind kind);

/// `count` scenes by the seeds `seed`, `seed` + 1, ..., with the recording's robot.
std::vector<StudyScene> drawn_scenes(const Recording& recording, std::uint32_t seed, int count,
                                     int width_px, int height_px);

/// 640 x 480, 8 links side by side, at 1.5 m; obstacles at 1 m. Every distance is 0.
StudyScene worst_case_scene();

}  // namespace berth::lab
