#include <fmt/format.h>
#include <tbb/global_control.h>

#include "apps/support/interrupt.hpp"
#include "apps/support/progress_bar.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/scene/open_scene.hpp"
#include "lab/bench/coarse_robot.hpp"
#include "lab/bench/embree_rays.hpp"
#include "lab/bench/growth.hpp"
#include "lab/bench/recorded_scenes.hpp"
#include "lab/bench/stage.hpp"
#include "lab/bench/statistics.hpp"
#include "lab/bench/triangle_count.hpp"

namespace berth::lab {
namespace {

constexpr int kThreads = 2;
/// Of each edge.
constexpr int kParts[] = {1, 2, 5, 8, 16};

Table::Row measure(const Recording& recording, const RobotModel& model, int rounds) {
  const OpenCamera& camera = recording.camera();
  const auto view = std::make_shared<const MountedCamera>(
      std::make_shared<const Robot>(model, camera.view->robot()->settings()), camera.view->mount(),
      camera.view->settings());
  const JointState& joints = camera.at_exposure.front();
  const DepthImage depth_m = camera.read_depth(0);
  Observer observer(view);
  Query query(view->robot());
  RobotRenderer renderer(view->robot()->meshes(), view->camera());
  EmbreeRays rays(model, view->camera());
  RobotPose pose;
  RobotImage image;
  RobotImage traced;
  Frame frame;
  forward_kinematics(model, joints.position, pose);
  const Pose X_BC = view->camera_pose(pose);
  Stage render{"render"};
  Stage whole{"depth image to result"};
  Stage embree{"Embree rays"};
  for (int round = 0; round < rounds; ++round) {
    app::stop_if_interrupted();
    render.take([&] { renderer.render(pose, X_BC, image); });
    whole.take([&] {
      observer.observe(depth_m, joints, frame);
      query.ask({.frames = frame});
    });
  }
  for (int round = 0; round < rounds; ++round) {
    embree.take([&] { rays.render(pose, X_BC, traced); });
  }
  return {fmt::format("{}", triangle_count(model)),
          {median(render.times_ms), percentile(render.times_ms, 0.99), median(whole.times_ms),
           percentile(whole.times_ms, 0.99), median(embree.times_ms)},
          ""};
}

}  // namespace

Table measure_growth_of_meshes(const std::filesystem::path& scene_file, int rounds) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  const auto recording = open_recording(scene_file, "bundled");
  const RobotSettings robot = read_scene(scene_file).robot;
  Table table{"Growth with the meshes",
              fmt::format("The robot of the bundled scene, its collision shapes made coarse and "
                          "then subdivided, the same surface in each row; {} threads, {} runs.",
                          kThreads, rounds),
              "triangles",
              {"render ms", "render p99 ms", "depth image to result ms",
               "depth image to result p99 ms", "Embree rays, same pixels ms"},
              {}};
  app::ProgressBar progress(table.title, std::size(kParts));
  for (const int parts : kParts) {
    table.rows.push_back(measure(*recording, coarse_robot(robot, parts), rounds));
    progress.step();
  }
  return table;
}

}  // namespace berth::lab
