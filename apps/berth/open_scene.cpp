#include "apps/berth/open_scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "apps/berth/interrupt.hpp"
#include "berth/io/camera_info.hpp"
#include "berth/io/joints_csv.hpp"
#include "berth/io/png.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

RobotSettings robot_settings(const SceneRobot& robot) {
  return {robot.urdf, robot.package_paths,
          robot.geometry == SceneRobot::Geometry::collision ? GeometryKind::collision
                                                            : GeometryKind::visual,
          robot.environment_links, robot.ignore_links};
}

template <typename T>
void set_if(T& setting, const std::optional<T>& given) {
  if (given) setting = *given;
}

RigSettings rig_settings(const SceneFile& scene, const EvaluationArguments& arguments) {
  RigSettings settings;
  set_if(settings.self_filter.tolerance_m, scene.self_filter.tolerance_m);
  set_if(settings.self_filter.tolerance_per_m, scene.self_filter.tolerance_per_m);
  set_if(settings.self_filter.tolerance_per_m2, scene.self_filter.tolerance_per_m2);
  set_if(settings.self_filter.padding_m, scene.self_filter.padding_m);
  set_if(settings.self_filter.dilation_px, scene.self_filter.dilation_px);
  set_if(settings.self_filter.edge_jump_m, scene.self_filter.edge_jump_m);
  set_if(settings.self_filter.island_radius_m, scene.self_filter.island_radius_m);
  set_if(settings.self_filter.island_jump_m, scene.self_filter.island_jump_m);
  set_if(settings.self_filter.robot_region_scale, scene.self_filter.robot_region_scale);
  settings.link_padding_m = scene.self_filter.link_padding_m;
  set_if(settings.distance.range_m, scene.evaluation.range_m);
  set_if(settings.distance.mean_direction, scene.evaluation.mean_direction);
  if (scene.evaluation.method && !arguments.method) {
    const auto method = method_from_name(*scene.evaluation.method);
    if (!method) {
      throw std::invalid_argument(fmt::format("evaluation.method: \"{}\"; expected one of {}",
                                              *scene.evaluation.method, method_names()));
    }
    settings.method = *method;
  }
  settings.method = arguments.method_over(settings.method);
  settings.distance = arguments.settings_over(settings.distance, settings.method);
  return settings;
}

JointTrajectory read_trajectory(const RobotModel& model, const std::filesystem::path& file) {
  const JointTable table = read_joints_csv(file);
  std::vector<JointTrajectory::Sample> samples;
  for (const auto& row : table.rows) samples.push_back({row.time_s, row.positions});
  return JointTrajectory(model, file.string(), table.names, samples);
}

OpenCamera open_camera(const SceneFile& scene, const SceneCamera& source, const RobotModel& model,
                       const JointTrajectory& joints, const EvaluationArguments& arguments) {
  OpenCamera camera;
  camera.source = source;
  const Camera intrinsics = read_camera_info(source.info);
  try {
    camera.rig =
        std::make_unique<const Rig>(model, CameraMount{intrinsics, source.parent_link, source.X_PC},
                                    rig_settings(scene, arguments));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
  }
  for (std::size_t frame = 0; frame < source.depth.size(); ++frame) {
    camera.at_exposure.push_back(source.stamps_s.empty() ? joints.sample(frame)
                                                         : joints.at(source.stamps_s[frame]));
    stop_if_interrupted();
    camera.read_depth(frame);
  }
  return camera;
}

}  // namespace

DepthImage OpenCamera::read_depth(std::size_t frame) const {
  return read_depth_png(source.depth[frame], rig->camera(), source.depth_scale_m, source.near_m,
                        source.far_m);
}

OpenScene open_scene(const std::filesystem::path& file, const EvaluationArguments& arguments) {
  const SceneFile source = read_scene(file);
  const RobotModel model = load_robot(robot_settings(source.robot));
  const JointTrajectory joints = read_trajectory(model, source.joints);
  OpenScene scene;
  for (const SceneCamera& camera : source.cameras) {
    scene.cameras.push_back(open_camera(source, camera, model, joints, arguments));
    scene.frame_count += camera.depth.size();
  }
  return scene;
}

}  // namespace berth
