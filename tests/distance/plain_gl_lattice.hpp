#pragma once

#include "berth/distance/settings.hpp"
#include "berth/types/link_distance.hpp"
#include "tests/support/random_images.hpp"

namespace berth::testing {

/// What gl_lattice has to find, pixel by pixel on the CPU; without mean directions.
LinkDistances plain_gl_lattice(const ImagePair& images, const DistanceSettings& settings);

}  // namespace berth::testing
