// What each step of a stream costs by itself.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "lab/stream/film.hpp"

namespace berth::lab {

/// Plays the film in one thread, as if each image were ready at once, and measures the processor
/// time of each step: image by image, of what is known in each request, of rows and filter after
/// it, and of requests to 1 mm without a deadline, of requests with all that is told, and of
/// requests with a budget of 0.5 ms.
nlohmann::ordered_json measure_steps(const Film& film, const StreamSettings& settings);

}  // namespace berth::lab
