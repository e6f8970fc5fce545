#pragma once

#include <filesystem>

#include "lab/bench/table.hpp"
#include "lab/bench/timing.hpp"

namespace berth::lab {

/// berth's exact method on random scenes of 8 links from 320 x 240 to 1920 x 1080; `scenes` of
/// each size.
Table measure_growth_of_image(int scenes, const RunLimits& limits);

/// The same at 640 x 480 from 8 to 64 links.
Table measure_growth_of_links(int scenes, const RunLimits& limits);

/// Rendering and the whole way with the collision shapes of a scene's robot, subdivided into up to
/// about a million triangles, two threads; `rounds` runs on the scene's first frame. Throws as
/// open_scene does.
Table measure_growth_of_meshes(const std::filesystem::path& scene_file, int rounds);

}  // namespace berth::lab
