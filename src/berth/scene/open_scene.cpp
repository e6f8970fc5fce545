#include "berth/scene/open_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "berth/files/camera_info.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"

namespace berth {
namespace {

JointTrajectory read_trajectory(const RobotModel& model, const SceneFile& scene) {
  const JointTable table = read_joints_csv(scene.joints);
  std::vector<double> offsets(table.names.size(), 0.0);
  for (const auto& [joint, offset] : scene.joint_offsets) {
    const auto at = std::find(table.names.begin(), table.names.end(), joint);
    if (at == table.names.end()) {
      throw std::runtime_error(fmt::format("{}: joint_offsets.{}: {} has no such joint; expected one of {}",
                                           scene.file.string(), joint, scene.joints.string(),
                                           fmt::join(table.names, ", ")));
    }
    offsets[at - table.names.begin()] = offset;
  }
  std::vector<JointTrajectory::Sample> samples;
  for (const auto& row : table.rows) {
    samples.push_back({row.time_s, row.positions});
    for (std::size_t i = 0; i < offsets.size(); ++i) samples.back().positions[i] += offsets[i];
  }
  return JointTrajectory(model, scene.joints.string(), table.names, samples);
}

TriangleMesh mesh_of(const SceneAttachment& attachment) {
  if (attachment.box_m) return make_box(*attachment.box_m);
  if (attachment.cylinder_m) {
    return make_cylinder(attachment.cylinder_m->x(), attachment.cylinder_m->y());
  }
  if (attachment.sphere_radius_m) return make_sphere(*attachment.sphere_radius_m);
  return read_mesh_file(attachment.mesh);
}

std::vector<Attachment> attached_to(const SceneFile& scene) {
  std::vector<Attachment> attached;
  for (const SceneAttachment& from : scene.attached) {
    const bool is_link = !from.name.empty();
    attached.push_back({is_link ? from.name : fmt::format("{} at {}", from.link, from.place),
                        from.link, mesh_of(from), from.X_LA, is_link});
  }
  return attached;
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
          source.stamps_s[frame] + source.clock_offset_s, camera.view->robot()->settings().time.joints, camera.at_exposure[frame]);
    }
    // The frame keeps its own stamp, the joints those of their clock.
    camera.at_exposure[frame].stamp_s -= source.clock_offset_s;
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
  const JointTrajectory joints = read_trajectory(model, source);
  scene.robot = with_file_named(source, [&] {
    return std::make_shared<const Robot>(std::move(model), source.evaluation, attached_to(source));
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
