#pragma once

#include "lab/bench/bench_scene.hpp"
#include "sim/random_images.hpp"

namespace berth::lab {

/// The images as a scene whose links have the shape that the camera sees.
BenchScene scene_of(sim::ImagePair images);

/// `count` scenes at 640 x 480, one in ten of them a contact, noise, plates or a checkerboard, the
/// rest random; the same ones at every call.
SceneSet random_scenes(int count);

/// Smooth surfaces everywhere equally far, where every pair ties, at 640 x 480;
/// `count` is at most kHardScenes.
inline constexpr int kHardScenes = 5;
SceneSet hard_scenes(int count);

}  // namespace berth::lab
