#pragma once

#include "thesis/image_request.hpp"
#include "thesis/link_distance.hpp"

namespace berth {

/// Per link the closest pair of all its pixels and all obstacle pixels: **the definition of
/// correct** (Hirt 2.10 to 2.14), and the baseline of benchmarks.
///
/// Of several pairs equally close, the first by rows. Fills everything but the mean direction (see
/// mean_direction.hpp); out.pairs counts robot pixels times obstacle pixels with a depth.
///
/// With another region than `image` in settings.surveillance, or the depth interval `cube`, each
/// robot pixel is tried against its region of surveillance only, which shrinks with the link's
/// closest pair unless settings.surveillance.shrinking says none (the thesis's baseline, figure
/// 3.5), and out.pairs counts what was tried. cube_projection and image change no distance. flacco
/// and cube can lose pairs: lower_bound_m is then 0.
///
/// Throws std::invalid_argument for bad settings.
void brute_force(const ImageRequest& request, LinkDistances& out);

}  // namespace berth
