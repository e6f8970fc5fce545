#include "sim/odd_views.hpp"

#include <algorithm>
#include <numbers>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_camera.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

constexpr DrawnSceneSettings kSmall{.width_px = 96, .height_px = 72};
constexpr int kCameras = 3;

/// The same camera with an image of another size.
Camera resized(Camera camera, int width_px, int height_px) {
  const double scale = static_cast<double>(width_px) / camera.width_px;
  camera.fx_px *= scale;
  camera.fy_px *= scale;
  camera.cx_px = (width_px - 1) / 2.0;
  camera.cy_px = (height_px - 1) / 2.0;
  camera.width_px = width_px;
  camera.height_px = height_px;
  return camera;
}

/// Changes the drawn views of one robot.
class OddViews {
 public:
  OddViews(const RobotModel& model, DrawnViews drawn) : model_(model), drawn_(std::move(drawn)) {}

  DrawnViews odd_sizes() {
    for (const auto& [width_px, height_px] :
         {std::pair(101, 67), std::pair(7, 5), std::pair(1, 1), std::pair(2, 33)}) {
      DrawnView view = drawn_.views[drawn_.views.size() % kCameras];
      view.camera = resized(view.camera, width_px, height_px);
      drawn_.views.push_back(std::move(view));
    }
    drawn_.views.erase(drawn_.views.begin(), drawn_.views.begin() + 2);
    return recast();
  }

  DrawnViews inside_robot() {
    drawn_.views[1].X_BC.translation() = extent_of(model_, drawn_.scene.pose).centre_B_m;
    return recast();
  }

  DrawnViews looking_away(bool all) {
    const Eigen::AngleAxisd back(std::numbers::pi, Eigen::Vector3d::UnitY());
    for (DrawnView& view : drawn_.views) {
      if (all || &view == &drawn_.views[1]) view.X_BC.rotate(back);
    }
    return recast();
  }

  DrawnViews identical() {
    drawn_.views[1] = drawn_.views[0];
    return drawn_;
  }

  DrawnViews covered() {
    for (const DrawnView& view : drawn_.views) {
      Pose X_BO = view.X_BC;
      X_BO.translation() += 0.1 * view.X_BC.linear().col(2);
      drawn_.scene.obstacles.push_back({make_box({1, 1, 0.01}), X_BO});
    }
    return recast();
  }

  DrawnViews contact() {
    const std::size_t link = model_.evaluated_links[model_.evaluated_links.size() / 2];
    Pose X_BO = Pose::Identity();
    X_BO.translation() =
        drawn_.scene.pose.X_BL[link] * model_.links[link].mesh_L.vertices_m.front().cast<double>();
    drawn_.scene.obstacles.push_back({make_box({0.1, 0.1, 0.1}), X_BO});
    return recast();
  }

  /// Long focal lengths.
  DrawnViews tip_alone() {
    const std::size_t tip = model_.evaluated_links.back();
    const Eigen::Vector3d tip_B = drawn_.scene.pose.X_BL[tip] *
                                  model_.links[tip].mesh_L.bounding_box_m().center().cast<double>();
    for (DrawnView& view : drawn_.views) {
      view.camera.fx_px *= 6;
      view.camera.fy_px *= 6;
      const Eigen::Vector3d to_tip = tip_B - view.X_BC.translation();
      view.X_BC.linear() = turn_between(Eigen::Vector3d::UnitZ(), to_tip).toRotationMatrix();
    }
    return recast();
  }

  /// Where keep(u, v) does not hold, the sensor gives nothing.
  template <class Keep>
  DrawnViews sensing(Keep keep) {
    for (DrawnView& view : drawn_.views) {
      for (int v = 0; v < view.camera.height_px; ++v) {
        for (int u = 0; u < view.camera.width_px; ++u) {
          if (keep(u, v)) continue;
          view.depth_m(u, v) = view.obstacles.depth_m(u, v) = kNoDepth;
          --view.obstacles.count[static_cast<std::size_t>(view.obstacles.fate(u, v))];
          ++view.obstacles.count[static_cast<std::size_t>(PixelFate::no_reading)];
          view.obstacles.fate(u, v) = PixelFate::no_reading;
        }
      }
    }
    return drawn_;
  }

 private:
  DrawnViews recast() {
    for (DrawnView& view : drawn_.views) {
      view = cast_view(model_, drawn_.scene.pose, drawn_.scene.obstacles, view.camera, view.X_BC);
    }
    return drawn_;
  }

  const RobotModel& model_;
  DrawnViews drawn_;
};

}  // namespace

std::vector<NamedViews> odd_views(const RobotModel& model, const std::vector<MeshTree>& link_trees,
                                  std::uint32_t seed) {
  const DrawnViews drawn = draw_views(model, link_trees, kSmall, seed, kCameras);
  DrawnSceneSettings empty_room = kSmall;
  empty_room.least_obstacles = empty_room.most_obstacles = 0;
  const auto odd = [&] { return OddViews(model, drawn); };
  return {{"odd sizes", odd().odd_sizes()},
          {"inside the robot", odd().inside_robot()},
          {"one looks away", odd().looking_away(false)},
          {"two identical", odd().identical()},
          {"all covered", odd().covered()},
          {"no robot in view", odd().looking_away(true)},
          {"contact", odd().contact()},
          {"the tip alone", odd().tip_alone()},
          {"no reading", odd().sensing([](int, int) { return false; })},
          {"a single reading", odd().sensing([](int u, int v) { return u == 20 && v == 10; })},
          {"an empty room", draw_views(model, link_trees, empty_room, seed, kCameras)}};
}

}  // namespace berth::sim
