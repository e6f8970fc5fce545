#pragma once

#include "berth/image_distance/settings.hpp"
#include "berth/types/link_distance.hpp"
#include "sim/random_images.hpp"

namespace berth::testing {

/// What gl_lattice has to find, pixel by pixel on the CPU; without mean directions.
LinkDistances plain_gl_lattice(const sim::ImagePair& images, const ImageDistanceSettings& settings);

}  // namespace berth::testing
