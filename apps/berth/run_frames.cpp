#include "apps/berth/run_frames.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "apps/berth/interrupt.hpp"
#include "apps/berth/picture.hpp"
#include "apps/berth/progress_bar.hpp"
#include "berth/pipeline/asker.hpp"

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

FrameResult result_of(const OpenCamera& camera, std::size_t frame_number, const Frame& frame,
                      const Answer& answer) {
  FrameResult result;
  result.frame = static_cast<int>(frame_number);
  result.stamp_s = frame.stamp_s;
  result.camera = camera.source.name;
  result.method = name_of(camera.rig->settings().method);
  const DistanceSettings& settings = camera.rig->settings().distance;
  result.range_m = settings.range_m;
  result.has_bounds = settings.tolerance_m > 0 || settings.deadline_us;
  result.link_names = camera.rig->model().evaluated_link_names();
  result.distances = &answer.distances;
  if (camera.rig->settings().visibility) result.visibility = &answer.visibility;
  result.X_BC = frame.X_BC;
  result.time = answer.time;
  result.self_filter = frame.obstacles.count;
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

}  // namespace

fs::path folder_of(const OpenScene& scene, const OpenCamera& camera, const fs::path& folder) {
  return scene.cameras.size() > 1 ? folder / camera.source.name : folder;
}

void make_folders(const OpenScene& scene, const fs::path& folder) {
  for (const OpenCamera& camera : scene.cameras) make_folder(folder_of(scene, camera, folder));
}

void learn_background(const OpenCamera& camera, Observer& observer) {
  if (camera.rig->settings().sensor.background_frames == 0) return;
  ProgressBar progress("background", camera.source.depth.size());
  Observer learner(*camera.rig);
  Frame frame;
  for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
    stop_if_interrupted();
    const DepthImage depth_m = camera.read_depth(i);
    learner.observe(depth_m, camera.at_exposure[i], frame, camera.exposure_time[i]);
    observer.learn_background(depth_m, frame);
    progress.step();
  }
}

void run_frames(const OpenScene& scene, const fs::path& picture_folder,
                const std::function<void(const FrameResult&)>& take) {
  const bool draws = !picture_folder.empty();
  if (draws) make_folders(scene, picture_folder);
  ProgressBar progress("run", scene.frame_count);
  for (const OpenCamera& camera : scene.cameras) {
    const fs::path pictures = folder_of(scene, camera, picture_folder);
    Observer observer(*camera.rig);
    learn_background(camera, observer);
    Asker asker(*camera.rig);
    Frame frame;
    for (std::size_t i = 0; i < camera.source.depth.size(); ++i) {
      stop_if_interrupted();
      const DepthImage depth_m = camera.read_depth(i);
      observer.observe(depth_m, camera.at_exposure[i], frame, camera.exposure_time[i]);
      const FrameResult result = result_of(camera, i, frame, asker.ask(frame));
      if (draws)
        draw(pictures / fmt::format("frame_{:06}.png", i), scene, camera, depth_m, frame, result);
      progress.clear();
      take(result);
      progress.step();
    }
  }
}

}  // namespace berth
