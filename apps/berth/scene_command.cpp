// run and filter: all frames of a scene.
#include <fmt/format.h>

#include "apps/berth/commands.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/run_frames.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/io/png.hpp"
#include "berth/self_filter/scenery.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

void write_images(const fs::path& folder, std::size_t frame_number, double depth_scale_m,
                  const Frame& frame) {
  const auto file = [&](const char* name) {
    return folder / fmt::format("{}_{:06}.png", name, frame_number);
  };
  RobotImage links = frame.robot;
  take_out_scenery(links);
  write_depth_png(file("robot_depth"), links.depth_m, depth_scale_m);
  write_link_ids_png(file("link_ids"), links.link_id);
  write_depth_png(file("obstacle_depth"), frame.obstacles.depth_m, depth_scale_m);
}

}  // namespace

void run_command(const RunArguments& arguments) {
  const OpenScene scene = open_scene(arguments.scene, arguments.evaluation);
  Output output(arguments.format, arguments.out);
  run_frames(scene, arguments.where, arguments.picture_folder,
             [&output](const FrameResult& result) { output.write(result); });
  output.finish();
}

void filter_command(const FilterArguments& arguments) {
  const OpenScene scene = open_scene(arguments.scene, {});
  // Whatever the scene's method is, it is not asked.
  const auto context = open_context(arguments.where, Method::exact);
  const auto pipelines = open_pipelines(scene, arguments.where.backend);
  make_folders(scene, arguments.out_folder);
  app::ProgressBar progress("filter", scene.frame_count);
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    const fs::path folder = folder_of(scene, camera, arguments.out_folder);
    observe_frames(camera, *pipelines[c], [&](std::size_t i, DepthView) {
      write_images(folder, i, camera.source.depth_scale_m, pipelines[c]->frame());
      progress.step();
    });
    if (context) context->check(camera.source.name);
  }
}

}  // namespace berth
