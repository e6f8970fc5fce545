// How long the whole robot's distances take, beside `exact` on the same scenes in the same run.
// Arguments: the scenes, the bundled arm's folder, the parts of each edge of its coarse meshes
// (3: 5 000 triangles a link), the threads.
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lab/bench/coarse_robot.hpp"
#include "berth/distance/exact/exact.hpp"
#include "berth/distance/mesh/mesh_distances.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "tests/support/drawn_scene.hpp"

namespace berth::lab {
namespace {

/// Of this thread, so that neighbours on the machine count little; of the clock on the wall where
/// several threads share the work.
double now_us(bool is_wall) {
  if (is_wall) {
    return std::chrono::duration<double, std::micro>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec * 1e6 + t.tv_nsec * 1e-3;
}

struct Row {
  std::string name;
  std::vector<double> us;
};

class Table {
 public:
  explicit Table(bool is_wall) : is_wall_(is_wall) {}

  /// The least of some runs, each after `prepare`.
  void measure(const std::string& name, const std::function<void()>& prepare,
               const std::function<void()>& work) {
    constexpr int kRuns = 3;
    double least_us = HUGE_VAL;
    for (int i = 0; i < kRuns; ++i) {
      prepare();
      const double begin_us = now_us(is_wall_);
      work();
      least_us = std::min(least_us, now_us(is_wall_) - begin_us);
    }
    row(name).us.push_back(least_us);
  }
  void add(const std::string& name, double value) { row(name).us.push_back(value); }

  void print() {
    for (Row& r : rows_) std::sort(r.us.begin(), r.us.end());
    const double unit_us = rows_[0].us[(rows_[0].us.size() - 1) / 2];
    fmt::print("{:34} {:>10} {:>10} {:>10} {:>8} {:>8}\n", "", "median", "95 %", "slowest",
               "x exact", "slowest");
    for (const Row& r : rows_) {
      const auto at = [&](double share) {
        return r.us[static_cast<std::size_t>(share * (r.us.size() - 1))];
      };
      fmt::print("{:34} {:10.1f} {:10.1f} {:10.1f} {:8.2f} {:8.2f}\n", r.name, at(0.5), at(0.95),
                 at(1), at(0.5) / unit_us, at(1) / unit_us);
    }
  }

 private:
  Row& row(const std::string& name) {
    for (Row& r : rows_) {
      if (r.name == name) return r;
    }
    return rows_.emplace_back(Row{name, {}});
  }

  bool is_wall_;
  std::vector<Row> rows_;
};

/// What one camera brought.
struct View {
  Pose X_BC;
  DepthImage depth_m;
  RobotImage robot;
  ObstacleImage obstacles;
  ViewSpace space;
};

void see(const testing::DrawnScene& scene, const RobotModel& model, View& view) {
  const RobotModel things = testing::obstacle_model(scene.obstacles);
  RobotImage seen;
  RobotRenderer(build_link_meshes(model), scene.camera).render(scene.pose, view.X_BC, view.robot);
  RobotRenderer(build_link_meshes(things), scene.camera)
      .render(testing::obstacle_pose(scene.obstacles), view.X_BC, seen);
  view.depth_m = seen.depth_m;
  for (std::size_t i = 0; i < view.depth_m.pixels().size(); ++i) {
    float& depth_m = view.depth_m.pixels()[i];
    const float robot_m = view.robot.depth_m.pixels()[i];
    if (!std::isnan(robot_m) && !(depth_m < robot_m)) depth_m = robot_m;
  }
  SelfFilterWorkspace workspace;
  self_filter(scene.camera, view.depth_m, view.robot, {}, workspace, view.obstacles);
}

/// Around the robot's middle, and up or down a little.
Pose turned_about(const Eigen::Vector3d& middle_m, double angle, const Pose& X_BC) {
  const Eigen::Translation3d to(middle_m);
  return to * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()) * to.inverse() * X_BC;
}

struct Scene {
  testing::DrawnScene drawn;
  std::vector<View> views;
  std::vector<RobotPose> next_poses;
};

Scene make_scene(const RobotModel& model, const std::vector<testing::MeshTree>& trees, int seed) {
  Scene scene{testing::draw_scene(model, trees, {}, static_cast<std::uint32_t>(seed)), {}, {}};
  testing::Random random(static_cast<std::uint32_t>(seed) + 1000);
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  for (const std::size_t link : model.evaluated_links) {
    middle_m += scene.drawn.pose.X_BL[link].translation() / model.link_count();
  }
  for (int k = 0; k < 3; ++k) {
    View& view = scene.views.emplace_back();
    view.X_BC = k == 0 ? scene.drawn.X_BC
                       : turned_about(middle_m, 2.1 * k + random(-0.5, 0.5), scene.drawn.X_BC);
    see(scene.drawn, model, view);
  }
  for (int i = 0; i < 3; ++i) {
    std::vector<double> positions = scene.drawn.joints.position;
    for (double& position : positions) position += random(-0.05, 0.05);
    forward_kinematics(model, positions, scene.next_poses.emplace_back());
  }
  return scene;
}

void measure_exact(const Scene& scene, int links, Table& table) {
  const View& view = scene.views[0];
  SearchableDepth searchable;
  searchable.build(view.obstacles.depth_m);
  const DistanceSettings settings{.range_m = 1.0, .mean_direction = false};
  ExactWorkspace workspace;
  LinkDistances out;
  table.measure(
      "exact, 1 camera", [&] { out.links.clear(); },
      [&] {
        exact({scene.drawn.camera, view.robot, links, searchable, settings}, workspace, out);
      });
}

void measure_mesh(Scene& scene, const RobotPatches& robot, Table& table) {
  std::vector<PosedView> posed;
  for (View& view : scene.views) {
    table.measure(
        "space of a frame", [] {},
        [&] {
          build_view_space(scene.drawn.camera, view.depth_m, view.obstacles, {}, view.space);
        });
    posed.push_back({&view.space, view.X_BC, 0});
  }
  HiddenSpace space;
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> out;
  MeshQuestion both;
  MeshQuestion readings;
  readings.hidden = false;
  const auto ask = [&](const RobotPose& pose, const MeshQuestion& question) {
    mesh_distances(robot, pose, space, question, workspace, out);
  };
  for (const int views : {1, 3}) {
    const auto renew = [&] {
      space.assign(std::span(posed).first(views));
      out.clear();
    };
    const std::string name = fmt::format("mesh, {} camera{}", views, views > 1 ? "s" : "");
    const RobotPose& pose = scene.drawn.pose;
    table.measure(name + ", readings", renew, [&] { ask(pose, readings); });
    table.measure(name + ", both", renew, [&] { ask(pose, both); });
    if (views == 1) continue;
    table.measure(
        name + ", both, again", [&] { out.clear(); }, [&] { ask(pose, both); });
    for (const RobotPose& next : scene.next_poses) {
      table.measure(
          name + ", both, next",
          [&] {
            renew();
            ask(pose, both);
            out.clear();
          },
          [&] { ask(next, both); });
    }
    table.add("(blocks kept)", static_cast<double>(space.kept_blocks()));
    table.measure(
        name + ", assign", [] {}, renew);
    renew();
    MeshQuestion hasty;
    hasty.deadline_us = 1000;
    ask(pose, hasty);
    for (const WholeLinkDistance& link : out) {
      const float upper_m = link.nearest.is_known() ? link.nearest.distance_m : 1;
      table.add("(gap in um after 1 ms, wall)", 1e6 * (upper_m - link.nearest.lower_bound_m));
    }
  }
}

void run(int scenes, const std::string& arm, int parts, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  RobotSettings settings;
  settings.urdf = arm + "/arm.urdf";
  settings.package_paths = {{"berth_arm", arm}};
  settings.environment_links = {"table"};
  const RobotModel model = coarse_robot(settings, parts);
  const auto trees = testing::build_link_trees(model);
  const auto robot = build_robot_patches(model);
  std::size_t triangles = 0;
  for (const LinkPatches& link : robot->links) triangles += link.triangle_count;
  fmt::print("{} scenes, {} links, {} triangles, {} threads\n", scenes, model.link_count(),
             triangles, threads);
  Table table(threads > 1);
  for (int seed = 0; seed < scenes; ++seed) {
    Scene scene = make_scene(model, trees, seed);
    measure_exact(scene, model.link_count(), table);
    measure_mesh(scene, *robot, table);
  }
  table.print();
}

}  // namespace
}  // namespace berth::lab

int main(int argc, char** argv) {
  const auto number = [&](int i, int otherwise) {
    return argc > i ? std::atoi(argv[i]) : otherwise;
  };
  berth::lab::run(number(1, 100), argc > 2 ? argv[2] : BERTH_BUNDLED_ARM, number(3, 3),
                    number(4, 1));
}
