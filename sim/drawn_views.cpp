#include "sim/drawn_views.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "sim/drawn_camera.hpp"
#include "sim/embree_renderer.hpp"
#include "sim/nearest_on_mesh.hpp"

namespace berth::sim {
namespace {

/// The size of camera i's image, as a part of that of the first one.
constexpr std::array kSizes = {1.0, 0.75, 0.5, 0.875};
constexpr int kMostCameraDraws = 300;

PixelFate fate_of(LinkId id, float sensed_m, float robot_m) {
  if (std::isnan(sensed_m)) return PixelFate::no_reading;
  if (std::isnan(robot_m) || sensed_m < robot_m) return PixelFate::obstacle;
  return id == kEnvironmentLink ? PixelFate::environment : PixelFate::robot;
}

/// An ideal self filter.
void remove_robot(DrawnView& view) {
  const int width = view.camera.width_px;
  const int height = view.camera.height_px;
  view.obstacles.depth_m = view.depth_m;
  view.obstacles.fate = Image<PixelFate>(width, height);
  view.obstacles.count = {};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const PixelFate fate =
          fate_of(view.robot.link_id(u, v), view.depth_m(u, v), view.robot.depth_m(u, v));
      if (!is_kept(fate)) view.obstacles.depth_m(u, v) = kNoDepth;
      view.obstacles.fate(u, v) = fate;
      ++view.obstacles.count[static_cast<std::size_t>(fate)];
    }
  }
}

bool sees_robot(const DrawnView& view) {
  const double pixels = view.camera.width_px * view.camera.height_px;
  return static_cast<double>(view.obstacles.count_of(PixelFate::robot)) > kLeastRobotShare * pixels;
}

bool is_clear(const Eigen::Vector3d& p_B, const std::vector<DrawnObstacle>& obstacles) {
  return std::none_of(obstacles.begin(), obstacles.end(), [&](const DrawnObstacle& obstacle) {
    const NearestPoint nearest =
        NearestOnMesh(obstacle.mesh_O)(obstacle.X_BO.inverse() * p_B, kLeastCameraClearance_m);
    return std::isfinite(nearest.distance_m);
  });
}

DrawnView draw_view(Random& random, const RobotModel& model, const DrawnScene& scene, double size) {
  const RobotExtent robot = extent_of(model, scene.pose);
  const int width_px = static_cast<int>(size * scene.camera.width_px);
  const int height_px = static_cast<int>(size * scene.camera.height_px);
  for (int i = 0; i < kMostCameraDraws; ++i) {
    const Camera camera = draw_camera(random, width_px, height_px);
    const Pose X_BC = draw_camera_pose(random, robot);
    if (!is_clear(X_BC.translation(), scene.obstacles)) continue;
    DrawnView view = cast_view(model, scene.pose, scene.obstacles, camera, X_BC);
    if (sees_robot(view)) return view;
  }
  throw std::runtime_error(
      fmt::format("robot \"{}\": none of {} cameras sees it", model.name, kMostCameraDraws));
}

}  // namespace

DrawnView cast_view(const RobotModel& model, const RobotPose& pose,
                    const std::vector<DrawnObstacle>& obstacles, const Camera& camera,
                    const Pose& X_BC) {
  DrawnView view{camera, X_BC, {}, {}, {}};
  view.robot = cast_image(EmbreeRenderer(model, pose, X_BC, camera), camera);
  view.depth_m = cast_obstacles(obstacles, camera, X_BC);
  for (std::size_t i = 0; i < view.depth_m.pixels().size(); ++i) {
    float& depth_m = view.depth_m.pixels()[i];
    depth_m = std::fmin(depth_m, view.robot.depth_m.pixels()[i]);
  }
  remove_robot(view);
  return view;
}

DrawnViews draw_views(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                      const DrawnSceneSettings& settings, std::uint32_t seed, int cameras) {
  DrawnViews drawn{draw_scene(model, link_trees, settings, seed), {}};
  const DrawnScene& scene = drawn.scene;
  drawn.views.push_back(cast_view(model, scene.pose, scene.obstacles, scene.camera, scene.X_BC));
  Random random(seed + 0x9e3779b9U);
  while (static_cast<int>(drawn.views.size()) < cameras) {
    const double size = settings.sizes_differ ? kSizes[drawn.views.size() % kSizes.size()] : 1;
    drawn.views.push_back(draw_view(random, model, scene, size));
  }
  return drawn;
}

PointView point_view(const DrawnView& view) {
  return {view.camera,         view.X_BC, view.depth_m, view.obstacles.depth_m,
          view.obstacles.fate, {},        {},           view.age_s};
}

PointSpace point_space(const std::vector<DrawnView>& views, const SpaceSettings& settings) {
  std::vector<PointView> point_views;
  for (const DrawnView& view : views) point_views.push_back(point_view(view));
  return {std::move(point_views), settings};
}

}  // namespace berth::sim
