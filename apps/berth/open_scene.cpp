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

SensorSettings sensor_settings(const SceneSensor& scene) {
  SensorSettings settings;
  set_if(settings.noise_m, scene.noise_m);
  set_if(settings.speckle_px, scene.speckle_px);
  set_if(settings.speckle_jump_m, scene.speckle_jump_m);
  set_if(settings.average_frames, scene.average_frames);
  set_if(settings.background_frames, scene.background_frames);
  set_if(settings.background_clearance_m, scene.background_clearance_m);
  for (const HolePolicy policy : kHolePolicies) {
    if (scene.holes == name_of(policy)) settings.holes = policy;
  }
  return settings;
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
  settings.time.joints = kOnlyBetweenSamples;
  set_if(settings.time.joints.max_skew_s, scene.time.max_skew_s);
  set_if(settings.time.joints.max_extrapolation_s, scene.time.max_extrapolation_s);
  settings.link_padding_m = scene.self_filter.link_padding_m;
  settings.sensor = sensor_settings(scene.sensor);
  set_if(settings.distance.range_m, scene.evaluation.range_m);
  set_if(settings.distance.mean_direction, scene.evaluation.mean_direction);
  set_if(settings.visibility, scene.evaluation.visibility);
  set_if(settings.visibility, arguments.visibility);
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

/// The joints at each exposure. Throws where none of the stamps can be meant for these joints.
void find_joints(const JointTrajectory& joints, OpenCamera& camera) {
  const SceneCamera& source = camera.source;
  camera.at_exposure.resize(source.depth.size());
  camera.exposure_time.resize(source.depth.size());
  bool any_ok = false;
  for (std::size_t frame = 0; frame < source.depth.size(); ++frame) {
    if (source.stamps_s.empty()) {
      camera.at_exposure[frame] = joints.sample(frame);
    } else {
      camera.exposure_time[frame] = joints.at(
          source.stamps_s[frame], camera.rig->settings().time.joints, camera.at_exposure[frame]);
    }
    any_ok |= camera.exposure_time[frame].status == TimeStatus::ok;
  }
  if (any_ok) return;
  throw std::runtime_error(
      fmt::format("{}: no joint angles for any stamp of camera {}, from {} to {} s; expected "
                  "times from {} to {} s",
                  joints.source(), source.name, source.stamps_s.front(), source.stamps_s.back(),
                  joints.first_s(), joints.last_s()));
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
  find_joints(joints, camera);
  for (std::size_t frame = 0; frame < source.depth.size(); ++frame) {
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
  scene.file = file;
  for (const SceneCamera& camera : source.cameras) {
    scene.cameras.push_back(open_camera(source, camera, model, joints, arguments));
    scene.frame_count += camera.depth.size();
  }
  return scene;
}

}  // namespace berth
