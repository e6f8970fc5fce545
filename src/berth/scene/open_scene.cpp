#include "berth/scene/open_scene.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "berth/files/camera_info.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

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
          source.stamps_s[frame], camera.view->robot()->settings().time.joints, camera.at_exposure[frame]);
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

/// Settings of a scene file whose domain only the robot and the camera tell.
template <class Make>
auto with_file_named(const SceneFile& scene, const Make& make) {
  try {
    return make();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", scene.file.string(), error.what()));
  }
}

std::size_t bytes_of(const DepthImage& image) {
  return image.pixels().size() * sizeof(image.pixels().front());
}

}  // namespace

DepthImage OpenCamera::read_depth(std::size_t frame) const {
  if (!kept_depth_m[frame].pixels().empty()) return kept_depth_m[frame];
  return read_depth_png(source.depth[frame], view->camera(), source.depth_scale_m, source.near_m,
                        source.far_m);
}

OpenScene open_scene(const SceneFile& source, const std::function<void()>& before_image) {
  OpenScene scene;
  scene.file = source.file;
  RobotModel model = load_robot(source.robot);
  const JointTrajectory joints = read_trajectory(model, source.joints);
  scene.robot = with_file_named(source, [&] {
    return std::make_shared<const Robot>(std::move(model), source.evaluation);
  });
  std::size_t kept_bytes = 0;
  for (const SceneCamera& from : source.cameras) {
    OpenCamera& camera = scene.cameras.emplace_back();
    camera.source = from;
    const CameraMount mount{read_camera_info(from.info), from.parent_link, from.X_PC};
    camera.view = with_file_named(
        source, [&] { return std::make_shared<const View>(scene.robot, mount, from.settings); });
    find_joints(joints, camera);
    camera.kept_depth_m.resize(from.depth.size());
    for (std::size_t frame = 0; frame < from.depth.size(); ++frame) {
      before_image();
      DepthImage depth_m = camera.read_depth(frame);
      kept_bytes += bytes_of(depth_m);
      if (kept_bytes <= kMostKeptBytes) camera.kept_depth_m[frame] = std::move(depth_m);
    }
    scene.frame_count += from.depth.size();
  }
  return scene;
}

OpenScene open_scene(const std::filesystem::path& file) { return open_scene(read_scene(file)); }

}  // namespace berth
