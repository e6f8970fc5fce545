// run and filter: all frames of a scene through the pipeline.
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "apps/berth/commands.hpp"
#include "apps/berth/interrupt.hpp"
#include "apps/berth/open_scene.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/picture.hpp"
#include "apps/berth/progress_bar.hpp"
#include "berth/io/png.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"

namespace berth {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder)) {
    throw std::runtime_error(fmt::format("{}: cannot be made: {}; expected a folder to write to",
                                         folder.string(),
                                         error ? error.message() : "a file of that name is there"));
  }
}

/// Several cameras have a folder each.
fs::path folder_of(const OpenScene& scene, const OpenCamera& camera, const fs::path& folder) {
  return scene.cameras.size() > 1 ? folder / camera.source.name : folder;
}

/// All of them, before the first result.
void make_folders(const OpenScene& scene, const fs::path& folder) {
  for (const OpenCamera& camera : scene.cameras) make_folder(folder_of(scene, camera, folder));
}

FrameResult result_of(const OpenCamera& camera, std::size_t frame_number, const Frame& frame,
                      const Answer& answer) {
  FrameResult result;
  result.frame = static_cast<int>(frame_number);
  result.stamp_s = frame.stamp_s;
  result.camera = camera.source.name;
  result.method = name_of(camera.rig->settings().method);
  result.range_m = camera.rig->settings().distance.range_m;
  result.link_names = camera.rig->model().evaluated_link_names();
  result.distances = &answer.distances;
  result.X_BC = frame.X_BC;
  result.self_filter = frame.obstacles.count;
  return result;
}

void draw(const fs::path& file, const OpenCamera& camera, DepthView sensor_depth_m,
          const Frame& frame, const FrameResult& result) {
  write_picture(file, {sensor_depth_m, &frame.robot, &frame.obstacles, result.distances,
                       result.link_names, result.range_m,
                       fmt::format("{}, camera {}, frame {}, {:.3f} s", camera.rig->model().name,
                                   camera.source.name, result.frame, frame.stamp_s)});
}

/// What the files show: the links that are evaluated, without scenery.
RobotImage without_environment(const RobotImage& robot) {
  RobotImage links = robot;
  for (std::size_t i = 0; i < links.link_id.pixels().size(); ++i) {
    if (links.link_id.pixels()[i] != kEnvironmentLink) continue;
    links.link_id.pixels()[i] = kNoLink;
    links.depth_m.pixels()[i] = kNoDepth;
  }
  return links;
}

void write_images(const fs::path& folder, std::size_t frame_number, double depth_scale_m,
                  const Frame& frame) {
  const auto file = [&](const char* name) {
    return folder / fmt::format("{}_{:06}.png", name, frame_number);
  };
  const RobotImage links = without_environment(frame.robot);
  write_depth_png(file("robot_depth"), links.depth_m, depth_scale_m);
  write_link_ids_png(file("link_ids"), links.link_id);
  write_depth_png(file("obstacle_depth"), frame.obstacles.depth_m, depth_scale_m);
}

}  // namespace

void run_command(const RunArguments& arguments) {
  const OpenScene scene = open_scene(arguments.scene, arguments.evaluation);
  Output output(arguments.format, arguments.out);
  const bool draws = !arguments.picture_folder.empty();
  if (draws) make_folders(scene, arguments.picture_folder);
  ProgressBar progress("run", scene.frame_count);
  for (const OpenCamera& camera : scene.cameras) {
    const fs::path pictures = folder_of(scene, camera, arguments.picture_folder);
    Observer observer(*camera.rig);
    Asker asker(*camera.rig);
    Frame frame;
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      stop_if_interrupted();
      const DepthImage depth_m = camera.read_depth(i);
      observer.observe(depth_m, camera.at_exposure[i], frame);
      const FrameResult result = result_of(camera, i, frame, asker.ask(frame));
      if (draws) {
        draw(pictures / fmt::format("frame_{:06}.png", i), camera, depth_m, frame, result);
      }
      progress.clear();
      output.write(result);
      progress.step();
    }
  }
  output.finish();
}

void filter_command(const FilterArguments& arguments) {
  const OpenScene scene = open_scene(arguments.scene, {});
  make_folders(scene, arguments.out_folder);
  ProgressBar progress("filter", scene.frame_count);
  for (const OpenCamera& camera : scene.cameras) {
    const fs::path folder = folder_of(scene, camera, arguments.out_folder);
    Observer observer(*camera.rig);
    Frame frame;
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      stop_if_interrupted();
      observer.observe(camera.read_depth(i), camera.at_exposure[i], frame);
      write_images(folder, i, camera.source.depth_scale_m, frame);
      progress.step();
    }
  }
}

}  // namespace berth
