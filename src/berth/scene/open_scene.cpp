#include "berth/scene/open_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "berth/files/camera_info.hpp"
#include "berth/files/edit_distance.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/files/joints_csv.hpp"
#include "berth/files/png.hpp"
#include "berth/robot/joint_trajectory.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/separation/protective_distance.hpp"

namespace berth {
namespace {

[[noreturn]] void throw_bad_joint(const SceneFile& scene, std::string_view key,
                                  const std::string& joint, std::string_view what) {
  throw std::runtime_error(fmt::format("{}: {}.{}: {}", scene.file.string(), key, joint, what));
}

void add_offsets(const SceneFile& scene, JointTable& table) {
  for (const auto& [joint, offset] : scene.joint_offsets) {
    const auto at = std::find(table.names.begin(), table.names.end(), joint);
    if (at == table.names.end()) {
      throw_bad_joint(scene, "joint_offsets", joint,
                      fmt::format("{} has no such joint; expected one of {}", scene.joints.string(),
                                  fmt::join(table.names, ", ")));
    }
    const auto column = at - table.names.begin();
    for (JointTable::Row& row : table.rows) row.positions[column] += offset;
  }
}

/// Throws unless it is a joint of the robot that moves and follows no other one.
void require_joint(const RobotModel& model, const SceneFile& scene, const std::string& joint) {
  std::vector<std::string_view> known;
  for (const MovableJoint& movable : model.joints) known.push_back(movable.name);
  if (std::find(known.begin(), known.end(), joint) != known.end()) return;
  const std::string expected = known.empty()
                                   ? "none"
                                   : fmt::format("{} (the nearest), or another of {}",
                                                 nearest(joint, known), fmt::join(known, ", "));
  throw_bad_joint(scene, "fixed_joints", joint,
                  fmt::format("no joint of robot \"{}\" that moves by itself; expected {}",
                              model.name, expected));
}

/// A column of one value for each.
void add_fixed_joints(const RobotModel& model, const SceneFile& scene, JointTable& table) {
  for (const auto& [joint, position] : scene.fixed_joints) {
    require_joint(model, scene, joint);
    if (std::find(table.names.begin(), table.names.end(), joint) != table.names.end()) {
      throw_bad_joint(scene, "fixed_joints", joint,
                      fmt::format("{} has a column of this joint too; expected one of both",
                                  scene.joints.string()));
    }
    table.names.push_back(joint);
    for (JointTable::Row& row : table.rows) row.positions.push_back(position);
  }
}

JointTrajectory read_trajectory(const RobotModel& model, const SceneFile& scene) {
  JointTable table = read_joints_csv(scene.joints);
  add_offsets(scene, table);
  add_fixed_joints(model, scene, table);
  std::vector<JointTrajectory::Sample> samples;
  for (const JointTable::Row& row : table.rows) samples.push_back({row.time_s, row.positions});
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

/// Which row belongs to which image is else a guess.
void require_one_row_each(const JointTrajectory& joints, const SceneCamera& camera) {
  if (joints.size() == camera.depth.size()) return;
  if (joints.size() > camera.depth.size() && joints.stands_still()) return;
  throw std::runtime_error(fmt::format(
      "{}: {} rows of joint angles for the {} images of camera {}, which has no stamps; "
      "expected a row for each image, or stamps",
      joints.source(), joints.size(), camera.depth.size(), camera.name));
}

double median_step(std::vector<double> times_s) {
  std::adjacent_difference(times_s.begin(), times_s.end(), times_s.begin());
  const auto middle = times_s.begin() + std::ssize(times_s) / 2;
  std::nth_element(times_s.begin() + 1, middle, times_s.end());
  return *middle;
}

/// Rows in milliseconds beside stamps in seconds lie seconds apart.
void require_one_unit(const JointTrajectory& joints, const SceneCamera& camera) {
  constexpr double kLeastStep_s = 1, kLeastRatio = 30;
  constexpr std::size_t kLeastRows = 10;
  if (camera.stamps_s.size() < 2 || joints.size() < kLeastRows) return;
  std::vector<double> times_s;
  for (std::size_t i = 0; i < joints.size(); ++i) times_s.push_back(joints.sample(i).stamp_s);
  const double row_s = median_step(times_s), image_s = median_step(camera.stamps_s);
  if (row_s < kLeastStep_s || row_s < kLeastRatio * image_s) return;
  throw std::runtime_error(
      fmt::format("{}: rows of joint angles are {:.4g} s apart, images of camera {} {:.4g} s; "
                  "expected both in seconds",
                  joints.source(), row_s, camera.name, image_s));
}

/// The joints at each exposure. Throws where none of the stamps can be meant for these joints.
void find_joints(const JointTrajectory& joints, OpenCamera& camera) {
  const SceneCamera& source = camera.source;
  source.stamps_s.empty() ? require_one_row_each(joints, source) : require_one_unit(joints, source);
  camera.at_exposure.resize(source.depth.size());
  camera.exposure_time.resize(source.depth.size());
  bool any_ok = false;
  for (std::size_t frame = 0; frame < source.depth.size(); ++frame) {
    if (source.stamps_s.empty()) {
      camera.at_exposure[frame] = joints.sample(frame);
    } else {
      camera.exposure_time[frame] =
          joints.at(source.stamps_s[frame] + source.clock_offset_s,
                    camera.mounted->robot()->settings().time.joints, camera.at_exposure[frame]);
    }
    // The frame keeps its own stamp, the joints those of their clock.
    camera.at_exposure[frame].stamp_s -= source.clock_offset_s;
    any_ok |= camera.exposure_time[frame].status == TimeStatus::ok;
  }
  if (any_ok) return;
  throw std::runtime_error(
      fmt::format("{}: no joint angles for any stamp of camera {}, from {} to {} s; expected "
                  "times from {} to {} s, and a row within {} s of a stamp where the robot moves "
                  "(time.max_skew_s); are both in seconds?",
                  joints.source(), source.name, source.stamps_s.front(), source.stamps_s.back(),
                  joints.first_s(), joints.last_s(),
                  camera.mounted->robot()->settings().time.joints.max_skew_s));
}

/// Throws MissingFile where there is nothing at the path that the scene's `key` names.
void require_file(const SceneFile& scene, const std::string& key,
                  const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_type type = std::filesystem::status(file, ignored).type();
  if (type != std::filesystem::file_type::not_found) return;
  throw MissingFile(fmt::format(
      "{}: {}: {}: No such file or directory; expected a readable file, its path relative to the "
      "scene's folder",
      scene.file.string(), key, file.string()));
}

void require_files(const SceneFile& scene) {
  require_file(scene, "robot.urdf", scene.robot.urdf);
  require_file(scene, "joints", scene.joints);
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    require_file(scene, fmt::format("cameras[{}].info", i), camera.info);
    if (camera.background) {
      require_file(scene, fmt::format("cameras[{}].background", i), *camera.background);
    }
  }
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

std::optional<SeparationSettings> checked_separation(const SceneFile& scene) {
  return with_file_named(scene, [&] {
    if (scene.separation) validate(*scene.separation);
    return scene.separation;
  });
}

/// All of the scene's next camera but its images.
OpenCamera& add_camera(const SceneFile& source, const Camera& pinhole,
                       std::shared_ptr<const Rectification> rectification, OpenScene& scene) {
  const SceneCamera& from = source.cameras[scene.cameras.size()];
  OpenCamera& camera = scene.cameras.emplace_back();
  camera.source = from;
  camera.rectification = std::move(rectification);
  const CameraMount mount{pinhole, from.parent_link, from.X_PC, from.name};
  camera.mounted = with_file_named(source, [&] {
    return std::make_shared<const MountedCamera>(scene.robot, mount, from.settings);
  });
  if (scene.separation) {
    const std::string trouble = detection_trouble(*scene.separation, *camera.mounted);
    if (!trouble.empty()) {
      scene.warnings.push_back(fmt::format("{}: {}", source.file.string(), trouble));
    }
  }
  find_joints(*scene.joints, camera);
  if (from.background) {
    camera.background_m = read_depth_png(*from.background, pinhole, kBackgroundScale_m);
  }
  return camera;
}

/// The scene's next camera.
OpenCamera& add_camera(const SceneFile& source, OpenScene& scene) {
  const SceneCamera& from = source.cameras[scene.cameras.size()];
  const CameraInfo info = read_camera_info(from.info, from.is_rectified);
  if (!info.lens && from.depth_is == DepthIs::along_axis)
    return add_camera(source, info.camera, nullptr, scene);
  const auto made = std::make_shared<const Rectification>(info.camera, info.lens, from.depth_is);
  return add_camera(source, made->camera(), made, scene);
}

/// The robot with the first `kept` of what is on it, and with `more`.
std::shared_ptr<const Robot> carrying(const std::shared_ptr<const Robot>& robot, std::size_t kept,
                                      const std::vector<Attachment>& more) {
  std::vector<Attachment> attached = robot->attached();
  if (attached.size() == kept + more.size()) return robot;
  attached.erase(attached.begin() + static_cast<std::ptrdiff_t>(kept), attached.end());
  attached.insert(attached.end(), more.begin(), more.end());
  return robot->with(std::move(attached));
}

/// A scene, each of whose images was checked by `check`.
OpenScene open_with(const SceneFile& source,
                    const std::function<void(OpenCamera&, std::size_t frame)>& check) {
  require_files(source);
  OpenScene scene;
  scene.file = source.file;
  scene.warnings = source.warnings;
  scene.joint_offsets = source.joint_offsets;
  RobotModel model = load_robot(source.robot);
  scene.joints = std::make_shared<const JointTrajectory>(read_trajectory(model, source));
  for (const std::vector<std::string>& more : {model.warnings, scene.joints->doubts(model)}) {
    scene.warnings.insert(scene.warnings.end(), more.begin(), more.end());
  }
  scene.robot = with_file_named(source, [&] {
    return std::make_shared<const Robot>(std::move(model), source.evaluation,
                                         attachments_of(source));
  });
  scene.separation = checked_separation(source);
  for (const SceneCamera& from : source.cameras) {
    OpenCamera& camera = add_camera(source, scene);
    camera.kept_depth_m.resize(from.depth.size());
    for (std::size_t frame = 0; frame < from.depth.size(); ++frame) {
      check(camera, frame);
    }
    scene.frame_count += from.depth.size();
  }
  return scene;
}

DepthImage decode(const OpenCamera& camera, std::size_t frame, double near_m, double far_m) {
  const SceneCamera& source = camera.source;
  return read_depth_png(source.depth[frame], camera.given(), source.depth_scale_m, near_m, far_m,
                        source.depth_offset_m);
}

DepthImage rectified(const OpenCamera& camera, DepthImage given_m) {
  return camera.rectification ? camera.rectification->apply(given_m) : given_m;
}

}  // namespace

bool tells_unread(const OpenCamera& camera) {
  return camera.mounted->settings().sensor.has_background() ||
         camera.mounted->settings().space.no_reading != NoReading::unknown;
}

DepthImage OpenCamera::read_depth(std::size_t frame) const {
  if (kept_depth_m[frame]) return *kept_depth_m[frame];
  return rectified(*this, read_given(frame));
}

DepthImage OpenCamera::read_given(std::size_t frame) const {
  return decode(*this, frame, source.near_m, source.far_m);
}

DepthImage OpenCamera::read_all_depth(std::size_t frame) const {
  return rectified(*this, decode(*this, frame, 0, std::numeric_limits<double>::infinity()));
}

std::vector<Attachment> attachments_of(const SceneFile& scene) {
  std::vector<Attachment> attached;
  for (const SceneAttachment& from : scene.attached) {
    const bool is_link = !from.name.empty();
    attached.push_back({is_link ? from.name : fmt::format("{} at {}", from.link, from.place),
                        from.link, mesh_of(from), from.X_LA, is_link, from.is_sharp, from.is_soft,
                        from.may_touch});
  }
  return attached;
}

OpenScene open_scene(const SceneFile& source, const std::function<void()>& before_image) {
  return open_with(source, [&](OpenCamera& camera, std::size_t frame) {
    before_image();
    check_depth_png(camera.source.depth[frame], camera.given(), camera.source.depth_scale_m);
  });
}

OpenScene open_scene_with_images(const SceneFile& source,
                                 const std::function<void()>& before_image) {
  std::size_t kept_bytes = 0;
  return open_with(source, [&](OpenCamera& camera, std::size_t frame) {
    before_image();
    DepthImage depth_m = camera.read_depth(frame);
    kept_bytes += bytes_of(depth_m);
    if (kept_bytes > kMostKeptBytes) return;
    camera.kept_depth_m[frame] = std::make_shared<const DepthImage>(std::move(depth_m));
  });
}

OpenScene open_scene(const std::filesystem::path& file) { return open_scene(read_scene(file)); }

OpenScene reopen_scene(const OpenScene& before, const SceneFile& changed,
                       const std::vector<Attachment>& carried) {
  OpenScene scene;
  scene.file = changed.file;
  scene.warnings = changed.warnings;
  scene.joint_offsets = changed.joint_offsets;
  scene.joints = changed.joint_offsets == before.joint_offsets
                     ? before.joints
                     : std::make_shared<const JointTrajectory>(
                           read_trajectory(before.robot->model(), changed));
  scene.robot = with_file_named(changed, [&] {
    return with_settings(carrying(before.robot, changed.attached.size(), carried),
                         changed.evaluation);
  });
  scene.separation = checked_separation(changed);
  scene.frame_count = before.frame_count;
  for (const OpenCamera& from : before.cameras) {
    add_camera(changed, from.mounted->camera(), from.rectification, scene).kept_depth_m =
        from.kept_depth_m;
  }
  return scene;
}

}  // namespace berth
