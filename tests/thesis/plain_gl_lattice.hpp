#pragma once

#include "sim/random_images.hpp"
#include "thesis/link_distance.hpp"
#include "thesis/settings.hpp"

namespace berth::testing {

/// What gl_lattice has to find, pixel by pixel on the CPU; without mean directions.
LinkDistances plain_gl_lattice(const sim::ImagePair& images, const ImageDistanceSettings& settings);

}  // namespace berth::testing
