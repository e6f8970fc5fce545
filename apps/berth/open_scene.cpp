#include "apps/berth/open_scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "apps/support/interrupt.hpp"
#include "berth/io/camera_info.hpp"
#include "berth/io/joints_csv.hpp"
#include "berth/io/png.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

RigSettings settings_of(const SceneFile& scene, const EvaluationArguments& arguments) {
  RigSettings settings = scene.settings;
  settings.visibility = arguments.visibility.value_or(settings.visibility);
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
                                    settings_of(scene, arguments));
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
  }
  find_joints(joints, camera);
  for (std::size_t frame = 0; frame < source.depth.size(); ++frame) {
    app::stop_if_interrupted();
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
  const RobotModel model = load_robot(source.robot);
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
