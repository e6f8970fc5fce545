#include <fmt/format.h>

#include <filesystem>

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
  ClosestApproach closest;
  std::string table;
  run_frames(scene, {arguments.picture_folder}, 0, [&](const Result& result) {
    if (closest.update(result)) table = result_table(result);
  });
  fmt::print("{}:\n\n{}\nPictures of all frames: {}\n", closest.text(scene), table,
             fs::absolute(arguments.picture_folder).lexically_normal().string());
}

}  // namespace berth::app
