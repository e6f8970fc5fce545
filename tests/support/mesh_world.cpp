#include "tests/support/mesh_world.hpp"

#include <cmath>
#include <iterator>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/embree_renderer.hpp"
#include "sim/turn_between.hpp"

namespace berth::testing {
namespace {

Eigen::Vector3d draw_direction(sim::Random& random) {
  return sim::draw_rotation(random) * Eigen::Vector3d::UnitX();
}

std::vector<sim::DrawnObstacle> draw_things(sim::Random& random, int count, double size_m,
                                            double reach_m) {
  std::vector<sim::DrawnObstacle> things;
  for (int i = 0; i < count; ++i) {
    sim::DrawnObstacle thing{sim::draw_obstacle(random, size_m * random(0.4, 1)),
                             Pose(sim::draw_rotation(random))};
    thing.X_BO.translation() = reach_m * random(0, 1) * draw_direction(random);
    things.push_back(std::move(thing));
  }
  return things;
}

MeshWorldView draw_view(sim::Random& random, const MeshWorldSettings& settings) {
  MeshWorldView view;
  view.camera = {settings.width_px, settings.height_px};
  view.camera.fx_px = settings.width_px * random(0.6, 1.1);
  view.camera.fy_px = view.camera.fx_px * random(0.95, 1.05);
  view.camera.cx_px = settings.width_px * random(0.4, 0.6) - 0.5;
  view.camera.cy_px = settings.height_px * random(0.4, 0.6) - 0.5;
  const Eigen::Vector3d away = draw_direction(random);
  const Eigen::Vector3d target_m = 0.2 * draw_direction(random);
  view.X_BC.linear() =
      sim::turn_between(Eigen::Vector3d::UnitZ(), -away).toRotationMatrix() *
      Eigen::AngleAxisd(random(-3, 3), Eigen::Vector3d::UnitZ()).toRotationMatrix();
  view.X_BC.translation() = target_m + random(0.7, 1.6) * away;
  return view;
}

PixelFate draw_fate(sim::Random& random, bool hides_otherwise) {
  constexpr PixelFate kFates[] = {PixelFate::flying_patch, PixelFate::speckle,
                                  PixelFate::padding,      PixelFate::background,
                                  PixelFate::hole,         PixelFate::outside_region,
                                  PixelFate::environment};
  const PixelFate fate = kFates[random.whole(0, static_cast<int>(std::size(kFates)) - 1)];
  const bool is_plain = fate != PixelFate::flying_patch && fate != PixelFate::hole;
  return is_plain || hides_otherwise ? fate : PixelFate::speckle;
}

void cast(sim::Random& random, const MeshWorldSettings& settings, const sim::EmbreeRenderer& robot,
          const sim::EmbreeRenderer& obstacles, MeshWorldView& view) {
  view.sensor_depth_m = DepthImage(settings.width_px, settings.height_px, kNoDepth);
  view.obstacles.depth_m = view.environment_back_m = view.sensor_depth_m;
  // In half of the images, blocks of pixels would show environment somewhere.
  const bool has_environment = random.chance(0.5) && settings.hides_otherwise;
  if (has_environment) view.environment_front_m = view.sensor_depth_m;
  for (int v = 0; v < settings.height_px && has_environment; ++v) {
    const double front_m = random(0.6, 3);
    for (int u = random.whole(0, settings.width_px); u < settings.width_px; ++u) {
      view.environment_front_m(u, v) = static_cast<float>(front_m);
    }
  }
  view.obstacles.fate =
      Image<PixelFate>(settings.width_px, settings.height_px, PixelFate::no_reading);
  for (int v = 0; v < settings.height_px; ++v) {
    for (int u = 0; u < settings.width_px; ++u) {
      const sim::RayHit near_robot = robot.hit(u, v);
      const sim::RayHit near_obstacle = obstacles.hit(u, v);
      const bool is_robot =
          near_robot.id != kNoLink &&
          !(near_obstacle.id != kNoLink && near_obstacle.depth_m < near_robot.depth_m);
      ++view.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)];
      if (random.chance(settings.dropout)) continue;
      const sim::RayHit& hit = is_robot ? near_robot : near_obstacle;
      if (hit.id == kNoLink) continue;
      float& sensed_m = view.sensor_depth_m(u, v);
      PixelFate& fate = view.obstacles.fate(u, v);
      sensed_m = static_cast<float>(hit.depth_m);
      fate = is_robot ? PixelFate::robot : PixelFate::obstacle;
      if (random.chance(0.02)) fate = draw_fate(random, settings.hides_otherwise);
      --view.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)];
      ++view.obstacles.count[static_cast<std::size_t>(fate)];
      if (is_kept(fate)) view.obstacles.depth_m(u, v) = sensed_m;
      if (fate == PixelFate::hole) sensed_m = kNoDepth;
      // Before the reading, behind it, farther than the robot may reach, or not known.
      if (random.chance(0.8)) {
        view.environment_back_m(u, v) = sensed_m + static_cast<float>(random(-0.1, 0.5));
      }
    }
  }
}

}  // namespace

MeshWorld draw_mesh_world(const MeshWorldSettings& settings, std::uint32_t seed) {
  sim::Random random(seed);
  MeshWorld world;
  world.settings = settings.space;
  const auto links = draw_things(random, settings.links, 0.15, 0.3);
  auto things = draw_things(random, settings.obstacles, 0.2, 0.6);
  if (random.chance(0.5)) {
    // A room around all.
    things.push_back({make_box(Eigen::Vector3d::Constant(random(4, 6))), Pose::Identity()});
  }
  world.model = sim::obstacle_model(links);
  world.pose = sim::obstacle_pose(links);
  const RobotModel obstacles = sim::obstacle_model(things);
  for (int k = 0; k < settings.views; ++k) {
    MeshWorldView view = draw_view(random, settings);
    cast(random, settings, sim::EmbreeRenderer(world.model, world.pose, view.X_BC, view.camera),
         sim::EmbreeRenderer(obstacles, sim::obstacle_pose(things), view.X_BC, view.camera), view);
    world.views.push_back(std::move(view));
  }
  return world;
}

PreparedWorld::PreparedWorld(const MeshWorld& world)
    : world_(world), patches_(build_robot_patches(world.model)), spaces_(world.views.size()) {
  std::vector<PosedSpace> posed;
  for (std::size_t k = 0; k < world.views.size(); ++k) {
    const MeshWorldView& view = world.views[k];
    build_camera_space(view.camera, view.sensor_depth_m, view.obstacles, view.environment(),
                       world.settings, spaces_[k]);
    posed.push_back({&spaces_[k], view.X_BC, view.age_s});
  }
  space_.assign(posed);
}

std::vector<WholeLinkDistance> PreparedWorld::ask(const MeshRequest& request) const {
  MeshWorkspace workspace;
  std::vector<WholeLinkDistance> out;
  mesh_distances(*patches_, world_.pose, space_, request, workspace, out);
  return out;
}

}  // namespace berth::testing
