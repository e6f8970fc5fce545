// run and filter: all frames of a scene.
#include <fmt/format.h>

#include "apps/berth/commands.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/run_frames.hpp"
#include "berth/files/png.hpp"
#include "berth/self_filter/environment.hpp"

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

}  // namespace

void run_command(const RunArguments& arguments) {
  const OpenScene scene = open_scene_over(arguments.scene, arguments.evaluation);
  Output output(arguments);
  // What is done is kept, whatever ends the run.
  const auto keep = [&] {
    if (arguments.out.empty() || output.count() == 0) return std::string();
    output.finish();
    return fmt::format("; {} holds {} results", arguments.out.string(), output.count());
  };
  try {
    run_frames(scene, arguments.where, arguments.picture_folder, arguments.repeat,
               [&output](const Result& result) { output.write(result); });
  } catch (const Interrupted& interrupted) {
    throw Interrupted{interrupted.done + keep()};
  } catch (const std::exception& error) {
    throw std::runtime_error(error.what() + keep());
  }
  output.finish();
}

void filter_command(const FilterArguments& arguments) {
  // Whatever the scene's method is, it is not asked; one result an image.
  EvaluationArguments on_the_cpu;
  on_the_cpu.method = name_of(Method::exact);
  const OpenScene scene = open_scene_over(arguments.scene, on_the_cpu);
  SceneRun run(scene, arguments.where, stop_if_interrupted);
  make_folders(scene, arguments.out_folder);
  each_frame(scene, run, "filter", [&] {
    write_images(folder_of(scene, run.camera(), arguments.out_folder), run, *run.frame());
  });
}

}  // namespace berth::app
