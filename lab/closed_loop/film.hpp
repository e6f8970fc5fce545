// Pictures of one encounter.
#pragma once

#include <filesystem>

#include "lab/closed_loop/simulation.hpp"

namespace berth::lab {

/// berth with three cameras, all defaults, in one encounter, of an arm with goals or one on its
/// path: writes film_0.png … film_4.png of the first camera at five times, and samples.csv with
/// each request, to a folder that is there. Throws std::runtime_error where they cannot be written.
void film_encounter(std::uint32_t seed, bool has_goals, const std::filesystem::path& folder);

}  // namespace berth::lab
