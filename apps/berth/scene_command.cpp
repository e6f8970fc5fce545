// run and filter: all frames of a scene.
#include <fmt/format.h>

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

/// Throws unless the scene has a result of this number.
void require_frame(const OpenScene& scene, std::size_t number) {
  const std::size_t last = scene_steps(scene).back().result;
  if (number <= last) return;
  throw std::invalid_argument(
      fmt::format("--frame {}: there is no such frame; expected 0 to {}", number, last));
}

}  // namespace

void run_command(const RunArguments& arguments) {
  const OpenScene scene = open_scene_over(arguments.scene, arguments.evaluation);
  if (arguments.frame) require_frame(scene, *arguments.frame);
  Output output(arguments);
  ClosestApproach closest;
  keep_what_is_done(arguments, output, [&] {
    run_frames(scene, {arguments.picture_folder, arguments.frame}, arguments.repeat,
               [&](const Result& result) {
                 output.write(result);
                 closest.update(result);
               });
  });
  if (!arguments.frame) output.close(closest.text(scene));
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
