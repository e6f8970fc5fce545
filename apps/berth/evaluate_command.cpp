#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <vector>

#include "apps/berth/commands.hpp"
#include "apps/berth/output.hpp"
#include "apps/berth/run_frames.hpp"
#include "apps/support/interrupt.hpp"
#include "berth/files/camera_info.hpp"
#include "berth/files/error.hpp"
#include "berth/files/png.hpp"
#include "thesis/image_scene.hpp"

namespace berth::app {
namespace {

struct ThreeImages {
  Camera camera;
  RobotImage robot;
  DepthImage obstacle_depth_m;
  int link_count = 0;
};

/// A link's pixel has a depth and an ID that a link can have; a depth without ID belongs to no
/// link.
void require_fitting_ids(ThreeImages& images, const EvaluateArguments& arguments) {
  for (int v = 0; v < images.camera.height_px; ++v) {
    for (int u = 0; u < images.camera.width_px; ++u) {
      const LinkId id = images.robot.link_id(u, v);
      const auto place = [&] {
        return FilePlace{arguments.link_ids, 0, fmt::format("pixel ({}, {})", u, v)};
      };
      if (id == kEnvironmentLink) {
        throw_bad_file(place(), fmt::format("link ID {}", id), "0 to 65534");
      }
      if (id != kNoLink && std::isnan(images.robot.depth_m(u, v))) {
        throw_bad_file(
            place(),
            fmt::format("link ID {} where {} has no depth", id, arguments.robot_depth.string()),
            "a depth at each pixel of a link");
      }
      if (id == kNoLink) images.robot.depth_m(u, v) = kNoDepth;
      images.link_count = std::max<int>(images.link_count, id);
    }
  }
}

ThreeImages read_images(const EvaluateArguments& arguments) {
  ThreeImages images;
  images.camera = read_camera_info(arguments.camera).camera;
  images.robot.depth_m =
      read_depth_png(arguments.robot_depth, images.camera, arguments.depth_scale_m);
  images.robot.link_id = read_link_ids_png(arguments.link_ids, images.camera);
  images.obstacle_depth_m =
      read_depth_png(arguments.obstacle_depth, images.camera, arguments.depth_scale_m);
  require_fitting_ids(images, arguments);
  return images;
}

/// The method, wherever it runs.
struct Evaluator {
  Evaluator(Method named, const BackendChoice& where)
      : gl(needed_gl_backend(named, where)),
        method(gl ? gl->make_method(named) : make_image_method(named)) {}

  std::unique_ptr<GlBackend> gl;
  std::unique_ptr<ImageMethod> method;
};

ImageResult result_of(const ThreeImages& images, const LinkDistances& distances) {
  ImageResult result;
  result.stamp_s = 0;
  result.timing_name = "evaluate_us";
  result.time.status = TimeStatus::ok;
  CameraResult& camera = result.cameras.emplace_back();
  camera.camera = "camera";
  camera.CameraState::status = CameraStatus::ok;
  for (int id = 1; id <= images.link_count; ++id) {
    LinkResult& link = result.links.emplace_back();
    link.id = static_cast<LinkId>(id);
    link.link = fmt::format("link_{}", id);
  }
  // Three images do not tell where the camera is.
  tell_image_distances(distances, unset_pose(), result);
  result.status = ResultStatus::ok;
  return result;
}

void evaluate_images(const EvaluateArguments& arguments) {
  const ThreeImages images = read_images(arguments);
  const ImageDistanceSettings settings =
      arguments.evaluation.over(ImageDistanceSettings{}, arguments.method);
  Output output(arguments);
  Evaluator evaluator(arguments.method, arguments.where);
  SearchableDepth obstacles;
  LinkDistances distances;
  std::vector<double> times_us;
  for (int i = 0; i < std::max(1, arguments.repeat); ++i) {
    stop_if_interrupted();
    // Each evaluation as if it were the first: exact would begin with the last answer.
    distances.links.clear();
    const auto start = std::chrono::steady_clock::now();
    if (evaluator.gl) {
      obstacles = SearchableDepth(images.obstacle_depth_m);
    } else {
      obstacles.build(images.obstacle_depth_m);
    }
    evaluator.method->evaluate(
        {images.camera, images.robot, images.link_count, obstacles, settings}, distances);
    if (evaluator.gl) evaluator.gl->check("evaluate");
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_us.push_back(took.count());
  }

  ImageResult result = result_of(images, distances);
  result.method = arguments.method;
  if (evaluator.gl) result.gl_renderer = evaluator.gl->renderer();
  result.range_m = settings.range_m;
  result.has_bounds = may_end_early(settings);
  if (arguments.repeat > 0) result.timing = timing_of(std::move(times_us));
  output.write(result);
  output.finish();
}

void evaluate_scene(const EvaluateArguments& arguments) {
  SceneFile file = read_scene(arguments.scene);
  ImageDistanceSettings settings;
  static_cast<DistanceSettings&>(settings) = file.evaluation.distance;
  settings = arguments.evaluation.over(settings, arguments.method);
  file.evaluation.distance = settings;
  file.evaluation.visibility = false;
  for (SceneCamera& camera : file.cameras) {
    camera.settings.self_filter.robot_region_scale = arguments.robot_region_scale;
  }
  const OpenScene scene = open_with_progress(file, "check images", open_scene);
  Output output(arguments);
  keep_what_is_done(arguments, output, [&] {
    ImageScene images(scene, arguments.method, settings, arguments.where, stop_if_interrupted);
    each_frame(
        scene, images.plausibility(), "evaluate", [&] { return images.next(); },
        [&] { output.write(images.ask(arguments.repeat)); });
  });
  output.finish();
}

}  // namespace

void evaluate_command(const EvaluateArguments& arguments) {
  arguments.scene.empty() ? evaluate_images(arguments) : evaluate_scene(arguments);
}

}  // namespace berth::app
