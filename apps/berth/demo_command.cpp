#include <fmt/format.h>

#include <filesystem>
#include <optional>

#include "apps/berth/commands.hpp"
#include "apps/berth/run_frames.hpp"
#include "apps/support/data_folders.hpp"
#include "berth/results/result_text.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

}  // namespace

void demo_command(const DemoArguments& arguments) {
  if (arguments.view) {
    // Nobody's own scene lies beside the bundled one.
    return view_command(
        {.scene = bundled_scene_file(), .port = arguments.port, .save_folder = fs::current_path()});
  }
  const OpenScene scene = open_scene_over(bundled_scene_file(), {});
  std::optional<float> least_m;
  std::string closest;
  run_frames(scene, {arguments.picture_folder}, 0, [&](const Result& result) {
    const LinkResult* nearest = result.nearest_link();
    if (!nearest || (least_m && *least_m <= nearest->distance_m)) return;
    least_m = nearest->distance_m;
    closest = fmt::format("The closest approach in {} images is in frame {}, {:.3f} s:\n\n{}",
                          scene.frame_count, result.frame, result.stamp_s, result_table(result));
  });
  fmt::print("{}\nPictures of all frames: {}\n", closest,
             fs::absolute(arguments.picture_folder).lexically_normal().string());
}

}  // namespace berth::app
