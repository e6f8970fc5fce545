#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "apps/berth/commands.hpp"
#include "apps/support/interrupt.hpp"
#include "apps/berth/output.hpp"
#include "berth/distance/evaluate.hpp"
#include "berth/files/camera_info.hpp"
#include "berth/files/error.hpp"
#include "berth/files/png.hpp"
#include "berth/scene/gl_backend.hpp"

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
  images.camera = read_camera_info(arguments.camera);
  images.robot.depth_m =
      read_depth_png(arguments.robot_depth, images.camera, arguments.depth_scale_m);
  images.robot.link_id = read_link_ids_png(arguments.link_ids, images.camera);
  images.obstacle_depth_m =
      read_depth_png(arguments.obstacle_depth, images.camera, arguments.depth_scale_m);
  require_fitting_ids(images, arguments);
  return images;
}

/// From three images in memory to the result, on the backend that the method runs on.
class Evaluator {
 public:
  Evaluator(Method method, const BackendChoice& where) : method_(method) {
    if (runs_on_opengl(method)) gl_ = open_gl_backend(where.gl_device);
  }

  void evaluate(const ThreeImages& images, const DistanceSettings& settings, LinkDistances& out) {
    if (gl_) {
      gl_->evaluate(method_,
                    {images.camera, images.robot, images.link_count,
                     SearchableDepth(images.obstacle_depth_m), settings},
                    out);
      gl_->check("evaluate");
      return;
    }
    obstacles_.build(images.obstacle_depth_m);
    berth::evaluate(method_, {images.camera, images.robot, images.link_count, obstacles_, settings},
                    workspace_, out);
  }

  std::string gl_renderer() const { return gl_ ? gl_->renderer() : ""; }

 private:
  Method method_;
  std::unique_ptr<GlBackend> gl_;
  SearchableDepth obstacles_;
  EvaluateWorkspace workspace_;
};

EvaluateTiming summary_of(std::vector<double> times_us) {
  std::sort(times_us.begin(), times_us.end());
  // The least time that this share of the evaluations did not exceed.
  const auto percentile = [&](double share) {
    return times_us[static_cast<std::size_t>(
                        std::ceil(share * static_cast<double>(times_us.size()))) -
                    1];
  };
  return {static_cast<int>(times_us.size()), times_us.front(), percentile(0.5), percentile(0.99),
          times_us.back()};
}

}  // namespace

void evaluate_command(const EvaluateArguments& arguments) {
  const ThreeImages images = read_images(arguments);
  const Method method = arguments.evaluation.method_over(Method::exact);
  const DistanceSettings settings = arguments.evaluation.settings_over({}, method);
  Output output(arguments.format, arguments.out);
  Evaluator evaluator(method, arguments.where);
  LinkDistances distances;
  std::vector<double> times_us;
  for (int i = 0; i < std::max(1, arguments.repeat); ++i) {
    stop_if_interrupted();
    // Each evaluation as if it were the first: exact would begin with the last answer.
    distances.links.clear();
    const auto start = std::chrono::steady_clock::now();
    evaluator.evaluate(images, settings, distances);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    times_us.push_back(took.count());
  }

  FrameResult result;
  result.camera = "camera";
  result.method = name_of(method);
  result.gl_renderer = evaluator.gl_renderer();
  result.range_m = settings.range_m;
  result.has_bounds = settings.tolerance_m > 0 || settings.deadline_us;
  for (int id = 1; id <= images.link_count; ++id)
    result.link_names.push_back(fmt::format("link_{}", id));
  result.distances = &distances;
  if (arguments.repeat > 0) result.timing = summary_of(std::move(times_us));
  output.write(result);
  output.finish();
}

}  // namespace berth::app
