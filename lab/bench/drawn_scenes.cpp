#include "lab/bench/drawn_scenes.hpp"

#include <fmt/format.h>

#include "lab/bench/hard_images.hpp"
#include "lab/bench/visible_shapes.hpp"

namespace berth::lab {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr int kLinks = 8;

constexpr double radians(double degrees) { return degrees * 3.14159265358979323846 / 180; }

sim::ImagePair random_or_special(int i) {
  const auto seed = static_cast<std::uint32_t>(i);
  switch (i % 40) {
    case 9:
      return contact_images(seed, kWidth, kHeight);
    case 19:
      return noise_images(seed, kWidth, kHeight);
    case 29:
      return plate_images(0, kWidth, kHeight);
    case 39:
      return checkerboard_images(1 + i / 40, kWidth, kHeight);
    default:
      return sim::random_images(seed, kWidth, kHeight, kLinks);
  }
}

/// Each kind comes early, for a run over the first few of them.
sim::ImagePair hard_images(int i) {
  switch (i) {
    case 0:
      return plate_images(radians(20), kWidth, kHeight);
    case 1:
      return ball_images(0.3, kWidth, kHeight);
    case 2:
      return plate_images(radians(5), kWidth, kHeight);
    case 3:
      return plate_images(radians(40), kWidth, kHeight);
    default:
      return ball_images(0.1, kWidth, kHeight);
  }
}

}  // namespace

BenchScene scene_of(sim::ImagePair images) {
  BenchScene scene;
  scene.shapes_L = visible_shapes_C(images.camera, images.robot, images.link_count);
  scene.X_CL.assign(images.link_count, Pose::Identity());
  scene.camera = images.camera;
  scene.robot = std::move(images.robot);
  scene.obstacle_depth_m = std::move(images.obstacle_depth_m);
  scene.link_count = images.link_count;
  return scene;
}

SceneSet random_scenes(int count) {
  return {"Random scenes",
          fmt::format("{} scenes by fixed seed, 640 x 480, 8 links, about 25 000 robot pixels, "
                      "range 1 m; one in ten a contact, noise, parallel plates or a checkerboard.",
                      count),
          count, [](int i) { return scene_of(random_or_special(i)); }};
}

SceneSet hard_scenes(int count) {
  return {"Hard scenes",
          fmt::format("{} of {}: smooth surfaces everywhere equally far. A plate before a parallel "
                      "plane, tilted by 5, 20 and 40 degrees; a ball in a shell, 0.1 and 0.3 m "
                      "away. 640 x 480, 8 links, range 1 m.",
                      count, kHardScenes),
          count, [](int i) { return scene_of(hard_images(i)); }};
}

}  // namespace berth::lab
