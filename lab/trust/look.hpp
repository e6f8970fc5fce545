#pragma once

#include <cstdint>
#include <filesystem>

#include "lab/trust/trial.hpp"

namespace berth::lab {

/// Prints what berth and the truth say of each link of one scene, as Markdown, and draws to
/// `picture` what the pipeline with default settings makes of the clean image.
void look_at_scene(const TrialRobot& robot, const sim::DrawnSceneSettings& settings,
                   std::uint32_t seed, const std::filesystem::path& picture);

}  // namespace berth::lab
