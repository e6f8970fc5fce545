#pragma once

#include <filesystem>
#include <vector>

#include "lab/bench/table.hpp"

namespace berth::lab {

/// Method `mesh` beside `exact`, with the robot of a scene file in drawn scenes that three cameras
/// see: the stages, two threads, growth with the meshes, and large images. Throws as open_scene
/// does.
std::vector<Table> measure_whole_robot(const std::filesystem::path& scene_file, int scenes);

/// What a user could take instead with several cameras, in the same scenes.
Table compare_whole_robot(const std::filesystem::path& scene_file, int scenes);

/// The robot of both, 8 links, its meshes made coarse and then cut into parts * parts triangles for
/// each: about 5 000 a link with kUsualParts.
inline constexpr int kUsualParts = 3;

}  // namespace berth::lab
