// run and filter: all frames of a scene.
#include <fmt/format.h>

#include "apps/berth/commands.hpp"
#include "apps/berth/interrupt.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/progress_bar.hpp"
#include "apps/berth/run_frames.hpp"
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
  run_frames(scene, arguments.picture_folder,
             [&output](const FrameResult& result) { output.write(result); });
  output.finish();
}

void filter_command(const FilterArguments& arguments) {
  const OpenScene scene = open_scene(arguments.scene, {});
  make_folders(scene, arguments.out_folder);
  ProgressBar progress("filter", scene.frame_count);
  for (const OpenCamera& camera : scene.cameras) {
    const fs::path folder = folder_of(scene, camera, arguments.out_folder);
    Observer observer(*camera.rig);
    learn_background(camera, observer);
    Frame frame;
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      stop_if_interrupted();
      observer.observe(camera.read_depth(i), camera.at_exposure[i], frame,
                       camera.exposure_time[i]);
      write_images(folder, i, camera.source.depth_scale_m, frame);
      progress.step();
    }
  }
}

}  // namespace berth
