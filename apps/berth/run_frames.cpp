#include "apps/berth/run_frames.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "apps/berth/picture.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"

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

FrameResult result_of(const OpenCamera& camera, std::size_t frame_number, FramePipeline& pipeline) {
  const Answer& answer = pipeline.ask();
  FrameResult result;
  result.frame = static_cast<int>(frame_number);
  result.stamp_s = pipeline.exposure().stamp_s;
  result.camera = camera.source.name;
  result.method = name_of(camera.rig->settings().method);
  const DistanceSettings& settings = camera.rig->settings().distance;
  result.range_m = settings.range_m;
  result.has_bounds = settings.tolerance_m > 0 || settings.deadline_us;
  result.link_names = camera.rig->model().evaluated_link_names();
  result.distances = &answer.distances;
  if (camera.rig->settings().visibility) result.visibility = &answer.visibility;
  result.X_BC = pipeline.exposure().X_BC;
  result.time = answer.time;
  result.self_filter = pipeline.fate_counts();
  return result;
}

void draw(const fs::path& file, const OpenScene& scene, const OpenCamera& camera,
          DepthView sensor_depth_m, const Frame& frame, const FrameResult& result) {
  const std::string which =
      scene.cameras.size() > 1 ? fmt::format(", camera {}", camera.source.name) : "";
  write_picture(file, {sensor_depth_m, &frame.robot, &frame.obstacles, result.distances,
                       result.link_names, result.range_m,
                       fmt::format("{}{}, frame {}, {:.3f} s", camera.rig->model().name, which,
                                   result.frame, frame.stamp_s)});
}

/// Where the scene asks for a background, from all images of its camera.
void learn_background(const OpenCamera& camera, Observer& observer) {
  if (!camera.rig->settings().sensor.has_background()) return;
  app::ProgressBar progress("background", camera.source.depth.size());
  Observer learner(*camera.rig);
  Frame frame;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    app::stop_if_interrupted();
    const DepthImage depth_m = camera.read_depth(i);
    learner.observe(depth_m, camera.at_exposure[i], frame, camera.exposure_time[i]);
    observer.learn_background(depth_m, frame);
    progress.step();
  }
}

}  // namespace

fs::path folder_of(const OpenScene& scene, const OpenCamera& camera, const fs::path& folder) {
  return scene.cameras.size() > 1 ? folder / camera.source.name : folder;
}

void make_folders(const OpenScene& scene, const fs::path& folder) {
  for (const OpenCamera& camera : scene.cameras) make_folder(folder_of(scene, camera, folder));
}

std::vector<std::unique_ptr<FramePipeline>> open_pipelines(const OpenScene& scene,
                                                           app::Backend backend) {
  std::vector<std::unique_ptr<FramePipeline>> pipelines;
  for (const OpenCamera& camera : scene.cameras) {
    try {
      pipelines.push_back(make_frame_pipeline(*camera.rig, backend));
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
    }
  }
  return pipelines;
}

void run_frames(const OpenScene& scene, const app::BackendArguments& where,
                const fs::path& picture_folder,
                const std::function<void(const FrameResult&)>& take) {
  const auto context = open_context(where, scene.method());
  const auto pipelines = open_pipelines(scene, where.backend);
  const bool draws = !picture_folder.empty();
  if (draws) make_folders(scene, picture_folder);
  app::ProgressBar progress("run", scene.frame_count);
  for (std::size_t c = 0; c < scene.cameras.size(); ++c) {
    const OpenCamera& camera = scene.cameras[c];
    const fs::path pictures = folder_of(scene, camera, picture_folder);
    observe_frames(camera, *pipelines[c], [&](std::size_t i, DepthView depth_m) {
      FrameResult result = result_of(camera, i, *pipelines[c]);
      if (context) result.gl_renderer = context->renderer();
      if (draws) {
        draw(pictures / fmt::format("frame_{:06}.png", i), scene, camera, depth_m,
             pipelines[c]->frame(), result);
      }
      if (context) context->check(camera.source.name);
      progress.clear();
      take(result);
      progress.step();
    });
  }
}

void observe_frames(const OpenCamera& camera, FramePipeline& pipeline,
                    const std::function<void(std::size_t, DepthView)>& take) {
  if (Observer* observer = pipeline.cpu_observer()) learn_background(camera, *observer);
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    app::stop_if_interrupted();
    const DepthImage depth_m = camera.read_depth(i);
    pipeline.observe(depth_m, camera.at_exposure[i], camera.exposure_time[i]);
    take(i, depth_m);
  }
}

}  // namespace berth
