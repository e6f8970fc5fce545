#include "apps/berth/run_frames.hpp"

#include <fmt/format.h>

#include <set>
#include <stdexcept>
#include <system_error>

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_projection.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/results/result_text.hpp"

namespace berth::app {
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

/// Such as ", speed: reduced to 42 %".
std::string speed_text(const Result& result) {
  if (!result.separation) return "";
  const std::string text = separation_text(result);
  return ", speed: " + text.substr(0, text.find(':'));
}

/// The camera's newest image, with the result; nothing where it has none yet.
void draw(const fs::path& folder, const OpenScene& scene, const SceneRun& run, std::size_t number,
          const Result& result) {
  const std::shared_ptr<const Frame> frame = run.frame(number);
  if (!frame) return;
  const OpenCamera& camera = scene.cameras[number];
  const std::string which =
      scene.cameras.size() > 1 ? fmt::format(", camera {}", camera.source.name) : "";
  const std::vector<PictureLink> links =
      projected(camera.mounted->camera(), frame->X_BC, result.links);
  write_picture(
      folder_of(scene, camera, folder) / fmt::format("frame_{:06}.png", result.frame),
      {run.sensor_depth_m(number), &frame->robot, &frame->obstacles, &links, result.range_m,
       fmt::format("{}{}, frame {}, {:.3f} s{}", scene.robot->model().name, which, result.frame,
                   frame->stamp_s, speed_text(result))});
}

void say(const OpenScene& scene, const std::string& text) {
  if (!text.empty()) fmt::print(stderr, "{}: {}\n", scene.file.string(), text);
}

/// Each camera that becomes implausible later than at its start, once.
class LateImplausible {
 public:
  explicit LateImplausible(const SceneRun& run) {
    for (const CameraPlausibility& camera : run.plausibility()) {
      if (camera.is_implausible) said_.insert(camera.camera);
    }
  }
  void update(const OpenScene& scene, const Result& result) {
    for (const CameraResult& camera : result.cameras) {
      if (camera.status != CameraStatus::implausible) continue;
      if (!said_.insert(camera.camera).second) continue;
      say(scene, fmt::format("camera {}: from its image {} on the robot is not where it should be; "
                             "its images are not used",
                             camera.camera, camera.frame));
    }
  }

 private:
  std::set<std::string> said_;
};

}  // namespace

OpenScene open_with_progress(const SceneFile& scene, const char* doing, OpenSceneFile open) {
  std::size_t images = 0;
  for (const SceneCamera& camera : scene.cameras) images += camera.depth.size();
  ProgressBar progress(doing, images);
  OpenScene opened = open(scene, [&progress] {
    stop_if_interrupted();
    progress.step();
  });
  progress.clear();
  // Before the images are refused: the cause may be among them.
  for (const std::string& warning : opened.warnings) fmt::print(stderr, "{}\n", warning);
  return opened;
}

OpenScene open_scene_over(const fs::path& file, const EvaluationArguments& arguments) {
  SceneFile scene = read_scene(file);
  scene.evaluation = arguments.over(scene.evaluation);
  return open_with_progress(scene, "check images", open_scene);
}

fs::path folder_of(const OpenScene& scene, const OpenCamera& camera, const fs::path& folder) {
  return scene.cameras.size() > 1 ? folder / camera.source.name : folder;
}

void make_folders(const OpenScene& scene, const fs::path& folder) {
  for (const OpenCamera& camera : scene.cameras) make_folder(folder_of(scene, camera, folder));
}

void each_frame(const OpenScene& scene, const std::vector<CameraPlausibility>& cameras,
                const char* doing, const std::function<bool()>& next,
                const std::function<void()>& take) {
  for (const CameraPlausibility& camera : cameras) say(scene, text_of(camera));
  ProgressBar progress(doing, scene.frame_count);
  std::size_t done = 0;
  const auto count_text = [&] {
    return fmt::format("after {} of {} images", done, scene.frame_count);
  };
  try {
    for (; next(); ++done) {
      stop_if_interrupted();
      progress.clear();
      take();
      progress.step();
    }
  } catch (const Interrupted&) {
    throw Interrupted{count_text()};
  } catch (const std::exception& error) {
    if (done == 0) throw;
    throw std::runtime_error(fmt::format("{}; ended {}", error.what(), count_text()));
  }
}

void each_frame(const OpenScene& scene, SceneRun& run, const char* doing,
                const std::function<void()>& take) {
  each_frame(
      scene, run.plausibility(), doing, [&run] { return run.next(); }, take);
}

void run_frames(const OpenScene& scene, const WantedFrames& wanted, int repeat,
                const std::function<void(const Result&)>& take) {
  SceneRun run(scene, stop_if_interrupted);
  run.stop_with(interruption());
  const bool draws = !wanted.folder.empty();
  if (draws) make_folders(scene, wanted.folder);
  LateImplausible late(run);
  Result result;
  bool is_done = false;
  const auto next = [&] { return !is_done && run.next(); };
  each_frame(scene, run.plausibility(), "run", next, [&] {
    if (run.begins_result()) {
      result = run.ask(repeat);
      stop_if_interrupted();
      late.update(scene, result);
    }
    is_done = wanted.only && *wanted.only == static_cast<std::size_t>(result.frame);
    if (wanted.only && !is_done) return;
    if (run.begins_result()) take(result);
    for (std::size_t i = 0; draws && i < scene.cameras.size(); ++i) {
      if (wanted.only || i == run.camera_number()) draw(wanted.folder, scene, run, i, result);
    }
  });
}

bool ClosestApproach::update(const Result& result) {
  const LinkResult* nearest = result.nearest_link();
  if (!nearest || (least_m_ && *least_m_ <= nearest->distance_m)) return false;
  least_m_ = nearest->distance_m;
  where_ = fmt::format("frame {}, {:.3f} s: {}, {:.3f} m", result.frame, result.stamp_s,
                       nearest->link, nearest->distance_m);
  return true;
}

std::string ClosestApproach::text(const OpenScene& scene) const {
  return least_m_
             ? fmt::format("The closest approach in {} images is in {}", scene.frame_count, where_)
             : fmt::format("No link has a distance in {} images", scene.frame_count);
}

}  // namespace berth::app
