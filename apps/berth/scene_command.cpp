// run and filter: all frames of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "apps/berth/commands.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/run_frames.hpp"
#include "berth/files/png.hpp"
#include "berth/self_filter/self_filter.hpp"

namespace berth::app {
namespace {

namespace fs = std::filesystem;

void write_images(const fs::path& folder, const SceneRun& run, const Frame& frame) {
  const auto file = [&](const char* name) {
    return folder / fmt::format("{}_{:06}.png", name, run.frame_number());
  };
  const double depth_scale_m = run.camera().source.depth_scale_m;
  RobotImage links = frame.robot;
  take_out_environment(links);
  write_depth_png(file("robot_depth"), links.depth_m, depth_scale_m);
  write_link_ids_png(file("link_ids"), links.link_id);
  write_depth_png(file("obstacle_depth"), frame.obstacles.depth_m, depth_scale_m);
}

/// Throws unless a camera has an image of this number.
void require_image(const OpenScene& scene, std::size_t number) {
  std::size_t most = 0;
  for (const OpenCamera& camera : scene.cameras) most = std::max(most, camera.source.depth.size());
  if (number < most) return;
  throw std::invalid_argument(
      fmt::format("--frame {}: there is no such image; expected 0 to {}", number, most - 1));
}

}  // namespace

void run_command(const RunArguments& arguments) {
  const OpenScene scene = open_scene_over(arguments.scene, arguments.evaluation);
  if (arguments.picture_image) require_image(scene, *arguments.picture_image);
  Output output(arguments);
  keep_what_is_done(arguments, output, [&] {
    run_frames(scene, {arguments.picture_folder, arguments.picture_image}, arguments.repeat,
               [&output](const Result& result) { output.write(result); });
  });
  output.finish();
}

void filter_command(const FilterArguments& arguments) {
  const OpenScene scene = open_scene_over(arguments.scene, {});
  SceneRun run(scene, stop_if_interrupted);
  make_folders(scene, arguments.out_folder);
  each_frame(scene, run, "filter", [&] {
    write_images(folder_of(scene, run.camera(), arguments.out_folder), run, *run.frame());
  });
}

}  // namespace berth::app
