#include <fmt/format.h>
#include <tbb/global_control.h>

#include "apps/berth/interrupt.hpp"
#include "apps/berth/open_scene.hpp"
#include "apps/berth/progress_bar.hpp"
#include "bench/growth.hpp"
#include "bench/statistics.hpp"
#include "bench/stopwatch.hpp"
#include "bench/subdivide.hpp"
#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"

namespace berth::bench {
namespace {

constexpr int kThreads = 2;
constexpr std::size_t kFewest = 3'000;
constexpr std::size_t kMost = 600'000;

std::size_t triangle_count(const RobotModel& model) {
  std::size_t count = 0;
  for (const Link& link : model.links) count += link.mesh_L.triangles.size();
  return count;
}

void refine(RobotModel& model) {
  for (Link& link : model.links) link.mesh_L = subdivide(link.mesh_L);
}

RobotModel load_coarse_robot(const SceneRobot& robot) {
  return load_robot({robot.urdf, robot.package_paths, GeometryKind::collision,
                     robot.environment_links, robot.ignore_links});
}

Table::Row measure(const OpenCamera& camera, const RobotModel& model, int rounds) {
  const Rig rig(model, {camera.rig->camera(), camera.source.parent_link, camera.source.X_PC},
                camera.rig->settings());
  const JointState& joints = camera.at_exposure.front();
  const DepthImage depth_m = camera.read_depth(0);
  Observer observer(rig);
  Asker asker(rig);
  RobotRenderer renderer(rig.meshes(), rig.camera());
  RobotPose pose;
  RobotImage image;
  Frame frame;
  forward_kinematics(model, joints.position, pose);
  std::vector<double> render_ms;
  std::vector<double> whole_ms;
  for (int round = 0; round < rounds; ++round) {
    stop_if_interrupted();
    const Stopwatch render_watch;
    renderer.render(pose, rig.camera_pose(pose), image);
    render_ms.push_back(render_watch.ms());
    const Stopwatch whole_watch;
    observer.observe(depth_m, joints, frame);
    asker.ask(frame);
    whole_ms.push_back(whole_watch.ms());
  }
  return {fmt::format("{}", triangle_count(model)), {median(render_ms), median(whole_ms)}, ""};
}

}  // namespace

Table measure_growth_of_meshes(const std::filesystem::path& scene_file, int rounds) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, kThreads);
  const OpenScene scene = open_scene(scene_file, {});
  RobotModel model = load_coarse_robot(read_scene(scene_file).robot);
  Table table{"Growth with the meshes",
              fmt::format("The robot of the bundled scene, its collision shapes subdivided; {} "
                          "threads, {} runs.",
                          kThreads, rounds),
              "triangles",
              {"render ms", "depth image to result ms"},
              {}};
  ProgressBar progress(table.title, 5);
  for (;;) {
    const std::size_t triangles = triangle_count(model);
    if (triangles >= kFewest) {
      table.rows.push_back(measure(scene.cameras.front(), model, rounds));
      progress.step();
    }
    if (triangles > kMost) return table;
    refine(model);
  }
}

}  // namespace berth::bench
