#include "lab/trust/real_image.hpp"

#include <cmath>

#include "berth/files/png.hpp"
#include "berth/render/robot_renderer.hpp"
#include "berth/self_filter/self_filter.hpp"
#include "sim/drawn_obstacles.hpp"
#include "sim/drawn_scene.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {
namespace {

struct Source {
  const char* file;
  Camera camera;
  double depth_scale_m;
};

/// Intrinsics and units as the folder's own files have them.
const Source kSources[] = {
    {"human/depth_image_1.png", {640, 480, 393.02, 393.02, 320.28, 243.87}, 0.001},
    {"d435_cloud/rs2_d435_848x480_one_cloud.png",
     {848, 480, 424.065, 424.065, 423.944, 240.805},
     0.001},
    {"panda_cylinder/depth_0.png", {640, 480, 525, 525, 319.5, 239.5}, 0.001},
    {"other_formats/other_formats/TUM_depth.png", {640, 480, 525, 525, 319.5, 239.5}, 0.0002}};

constexpr double kLeastRobotShare = 0.01;
constexpr double kRobotNoise_m_at_1m = 0.0015;

/// One of the links at a random point before the camera, the robot turned at random.
Pose draw_camera_pose(sim::Random& random, const Camera& camera, const TrialRobot& robot,
                      const RobotPose& pose) {
  const int last = static_cast<int>(robot.model.evaluated_links.size()) - 1;
  const std::size_t link = robot.model.evaluated_links[random.whole(0, last)];
  const double z_m = random(0.6, 1.8);
  const double u = random(0.2, 0.8) * camera.width_px, v = random(0.2, 0.8) * camera.height_px;
  const Eigen::Vector3d p_C((u - camera.cx_px) * z_m / camera.fx_px,
                            (v - camera.cy_px) * z_m / camera.fy_px, z_m);
  Pose X_CB = Pose::Identity();
  X_CB.linear() = sim::draw_rotation(random).toRotationMatrix();
  X_CB.translation() = p_C - X_CB.linear() * pose.X_BL[link].translation();
  return X_CB.inverse();
}

/// Fills both images; the number of pixels that show the robot.
int compose(const DepthImage& scene_m, const DepthImage& robot_m, RealScene& out) {
  out.depth_m = out.obstacle_depth_m = scene_m;
  int shown = 0;
  for (std::size_t i = 0; i < scene_m.pixels().size(); ++i) {
    const float robot = robot_m.pixels()[i], scene = scene_m.pixels()[i];
    if (std::isnan(robot) || robot >= scene) continue;
    out.depth_m.pixels()[i] = robot;
    out.obstacle_depth_m.pixels()[i] = kNoDepth;
    ++shown;
  }
  return shown;
}

bool is_clear(const LinkDistances& distances) {
  for (const LinkDistance& link : distances.links) {
    if (link.status == LinkStatus::ok && link.distance_m < kRealClearance_m) return false;
  }
  return true;
}

}  // namespace

std::vector<RealImage> load_real_images(const std::filesystem::path& folder) {
  std::vector<RealImage> images;
  for (const Source& source : kSources) {
    const std::filesystem::path file = folder / source.file;
    images.push_back({file.parent_path().filename().string(), source.camera,
                      read_depth_png(file, source.camera, source.depth_scale_m)});
  }
  return images;
}

std::optional<RealScene> draw_into(const RealImage& image, const TrialRobot& robot,
                                   std::uint32_t seed) {
  sim::Random random(seed);
  RobotPose pose;
  forward_kinematics(robot.model, sim::draw_joints(random, robot.model).position, pose);
  RealScene scene{&image, &robot, {}, {}, {}, {}};
  RobotRenderer(robot.meshes, image.camera)
      .render(pose, draw_camera_pose(random, image.camera, robot, pose), scene.robot_image);
  // It stands where it stands: anywhere in a real scene it would cut through things.
  take_out_environment(scene.robot_image);
  DepthImage robot_m = scene.robot_image.depth_m;
  sim::add_noise(kRobotNoise_m_at_1m, seed + 1, robot_m);
  const int shown = compose(image.depth_m, robot_m, scene);
  if (shown < kLeastRobotShare * image.camera.width_px * image.camera.height_px) return {};
  scene.ideal = exact_distances(image.camera, scene.robot_image, robot.model.link_count(),
                                scene.obstacle_depth_m);
  if (!is_clear(scene.ideal)) return {};
  return scene;
}

}  // namespace berth::lab
