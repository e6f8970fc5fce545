#include "node_settings.hpp"

#include <algorithm>
#include <array>

#include "berth/files/edit_distance.hpp"
#include "berth/pipeline/request.hpp"
#include "srdf.hpp"

namespace berth_ros {
namespace {

using rcl_interfaces::msg::ParameterDescriptor;

ParameterDescriptor described(const std::string& text, bool is_read_only = true) {
  ParameterDescriptor descriptor;
  descriptor.description = text;
  descriptor.read_only = is_read_only;
  return descriptor;
}

constexpr std::array<const char*, 8> kGroups = {"self_filter", "sensor", "space",      "watch",
                                                "evaluation",  "time",   "separation", "filter"};
constexpr const char* kMonitor = "separation.monitor";

/// All overrides NAME: number below a prefix, declared.
std::map<std::string, double> declare_numbers(SettingNode& node, const std::string& prefix,
                                              const std::string& sentence) {
  std::map<std::string, double> numbers;
  for (const auto& [name, value] :
       node.get_node_parameters_interface()->get_parameter_overrides()) {
    if (name.rfind(prefix + ".", 0) != 0) continue;
    numbers[name.substr(prefix.size() + 1)] =
        node.declare_parameter(name, rclcpp::ParameterType::PARAMETER_DOUBLE, described(sentence))
            .get<double>();
  }
  return numbers;
}

/// Names that no node declares itself, but ROS does, now or later.
bool is_of_ros(const std::string& name) {
  for (const std::string before : {"qos_overrides.", "diagnostic_updater."}) {
    if (name.rfind(before, 0) == 0) return true;
  }
  return name == "use_sim_time" || name == "start_type_description_service";
}

/// The last part of the name of each parameter that one camera has, with the camera's name before
/// it in one node and without in the other.
constexpr std::array<const char*, 12> kCameraKeys = {
    "image_transport", "rectified",  "depth_is",     "depth_scale",
    "depth_offset_m",  "near_m",     "far_m",        "filtered",
    "clock_offset_s",  "max_wait_s", "camera_poses", "reliability"};
/// Of distance_node alone.
constexpr std::array<const char*, 2> kDistanceKeys = {"cameras", "velocity_window_s"};

bool is_among(const auto& keys, const std::string& name) {
  return std::any_of(keys.begin(), keys.end(), [&](const char* key) { return name == key; });
}

/// Whether the other of the two nodes has a parameter of this name: files may be for both.
bool is_of_other_node(const std::string& name, bool has_one_camera) {
  if (!has_one_camera) return name == "camera" || is_among(kCameraKeys, name);
  if (is_among(kDistanceKeys, name) || name.ends_with("_rate_hz")) return true;
  for (const std::string group : {"separation.", "filter.", "planner.", "record."}) {
    if (name.rfind(group, 0) == 0) return true;
  }
  // One camera's own: the names of cameras are anybody's choice.
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) return false;
  const std::string key = name.substr(dot + 1);
  return is_among(kCameraKeys, key) || is_among(kGroups, key.substr(0, key.find('.')));
}

PoseSource pose_source_of(const std::string& text) {
  if (text == "auto") return PoseSource::automatic;
  if (text == "tf") return PoseSource::tf;
  if (text == "scene") return PoseSource::scene;
  throw std::invalid_argument("camera_poses: \"" + text + "\"; expected one of auto, tf, scene");
}

berth::DepthIs depth_is_of(const std::string& text) {
  if (text == "axis") return berth::DepthIs::along_axis;
  if (text == "ray") return berth::DepthIs::along_ray;
  throw std::invalid_argument("depth_is: \"" + text + "\"; expected axis or ray");
}

/// A bool that may be absent: camera_info does not say whether images still have its distortion.
std::optional<bool> declare_rectified(SettingNode& node, const std::string& name,
                                      std::optional<bool> value) {
  ParameterDescriptor descriptor = described(
      "true: the images are rectified: camera_info's P counts, and its distortion does not; false: "
      "they are as the lens made them, and berth rectifies them; needed where camera_info has "
      "distortion");
  descriptor.dynamic_typing = true;
  const rclcpp::ParameterValue given = node.declare_parameter(
      name, value ? rclcpp::ParameterValue(*value) : rclcpp::ParameterValue(), descriptor);
  if (given.get_type() == rclcpp::ParameterType::PARAMETER_NOT_SET) return {};
  if (given.get_type() == rclcpp::ParameterType::PARAMETER_BOOL) return given.get<bool>();
  throw std::invalid_argument(name + ": " + rclcpp::to_string(given) + "; expected true or false");
}

bool is_reliable_of(const std::string& text) {
  if (text == "best_effort" || text == "reliable") return text == "reliable";
  throw std::invalid_argument("reliability: \"" + text + "\"; expected best_effort or reliable");
}

/// Where no calibration said what is normal. On four recordings, cameras in their places show 18 mm
/// at most, and those that are 5 cm off 33 mm at least; two of three images have to agree.
constexpr double kDisplacement_m = 0.03;

/// A camera of a node that no scene file describes.
berth::CameraSettings watched_camera() {
  berth::CameraSettings settings = berth::settings_of_real_camera();
  settings.watch.max_displacement_m = kDisplacement_m;
  return settings;
}

}  // namespace

NodeSettings::NodeSettings(SettingNode& node, bool has_one_camera) {
  const std::string scene = node.declare_parameter(
      "scene", "",
      described("a scene file: robot, cameras and settings; parameters go over it. "
                "Its time: is about its recording and not heeded"));
  if (!scene.empty()) scene_ = berth::read_scene(scene);
  if (scene_) judge_scene(node);
  declare_robot(node);
  declare_joints(node);
  declare_evaluation(node);
  declare_cameras(node, has_one_camera);
  world_frame_ = node.declare_parameter(
      "world_frame", "",
      described("a frame of TF that stands still, for a robot whose base moves (odom, map): images "
                "of other times are placed where the base was then; empty: the base stands still"));
  if (!has_one_camera) {
    declare_separation(node);
    declare_filter(node);
  }
  check({});
  warn_unwatched(node);
}

void NodeSettings::require_declared(SettingNode& node, bool has_one_camera) {
  const std::vector<std::string> known = node.list_parameters({}, 0).names;
  const std::vector<std::string_view> candidates(known.begin(), known.end());
  for (const auto& [name, value] :
       node.get_node_parameters_interface()->get_parameter_overrides()) {
    if (node.has_parameter(name) || is_of_ros(name) || is_of_other_node(name, has_one_camera)) {
      continue;
    }
    throw std::invalid_argument(name + ": there is no such parameter; the nearest is " +
                                std::string(berth::nearest(name, candidates)));
  }
}

void NodeSettings::warn_unwatched(const SettingNode& node) const {
  for (const CameraSettings& camera : cameras()) {
    if (camera.settings.watch.is_on() || camera.is_filtered) continue;
    RCLCPP_WARN(node.get_logger(),
                "camera %s: nobody watches whether it is moved, since watch.max_displacement_m and "
                "watch.max_seen_through are 0; %g suits most cameras, and `berth calibrate` finds "
                "both",
                camera.name.c_str(), kDisplacement_m);
  }
}

void NodeSettings::judge_scene(const SettingNode& node) const {
  for (const std::string& warning : scene_->warnings) {
    RCLCPP_WARN(node.get_logger(), "%s", warning.c_str());
  }
}

void NodeSettings::declare_robot(SettingNode& node) {
  if (scene_) robot_ = scene_->robot;
  urdf_path_ = node.declare_parameter(
      "urdf_path", scene_ ? scene_->robot.urdf.string() : std::string(),
      described("the robot's URDF; empty: the topic robot_description has it"));
  robot_.urdf = urdf_path_.empty() ? "robot_description" : urdf_path_;
  const std::string geometry = node.declare_parameter(
      "geometry", robot_.geometry == berth::GeometryKind::visual ? "visual" : "collision",
      described("which shapes of the URDF are the robot: visual or collision"));
  if (geometry != "visual" && geometry != "collision") {
    throw std::invalid_argument("geometry: \"" + geometry + "\"; expected visual or collision");
  }
  robot_.geometry =
      geometry == "visual" ? berth::GeometryKind::visual : berth::GeometryKind::collision;
  robot_.environment_links = node.declare_parameter(
      "environment_links", robot_.environment_links,
      described("links that are environment: taken out of the images, not evaluated"));
  robot_.ignore_links =
      node.declare_parameter("ignore_links", robot_.ignore_links,
                             described("links that are neither taken out nor evaluated"));
  robot_.guarded_links = node.declare_parameter(
      "guarded_links", robot_.guarded_links,
      described("links whose boxes nobody can be in, neither taken out nor evaluated"));
  const std::string srdf =
      node.declare_parameter("srdf_path", "",
                             described("MoveIt's SRDF: links that it takes out of all collisions "
                                       "(disable_default_collisions) are among ignore_links"));
  if (srdf.empty()) return;
  for (const std::string& link : links_without_collisions(srdf)) {
    RCLCPP_INFO(node.get_logger(), "%s ignores the link %s", srdf.c_str(), link.c_str());
    robot_.ignore_links.push_back(link);
  }
}

void NodeSettings::declare_joints(SettingNode& node) {
  if (scene_) {
    joints_.offsets = scene_->joint_offsets;
    joints_.fixed = scene_->fixed_joints;
  }
  joints_.max_hold_s = node.declare_parameter(
      "max_joint_hold_s", 0.0,
      described("a joint keeps its last position for so long while newer ones of others come: for "
                "a gripper that tells its joints more seldom than the arm"));
  for (const auto& [joint, value] :
       declare_numbers(node, "joint_offsets", "added to this joint's positions, rad or m")) {
    joints_.offsets[joint] = value;
  }
  for (const auto& [joint, value] : declare_numbers(
           node, "fixed_joints", "the position of a joint that nobody tells, rad or m")) {
    joints_.fixed[joint] = value;
  }
}

berth::EvaluationSettings NodeSettings::scene_evaluation() const {
  berth::EvaluationSettings settings;
  if (scene_) settings = scene_->evaluation;
  return settings;
}

void NodeSettings::declare_evaluation(SettingNode& node) {
  const berth::EvaluationSettings evaluation = scene_evaluation();
  const berth::TimeSettings time;
  declare_settings(node, "evaluation", setting_refs(evaluation), given_);
  declare_settings(node, "time", setting_refs(time), given_);
  berth::CameraSettings settings = watched_camera();
  if (scene_) settings = scene_->cameras.front().settings;
  visit_setting_groups(settings, [&](const std::string& group, const auto& listed) {
    declare_settings(node, group, setting_refs(listed), given_);
  });
}

void NodeSettings::declare_cameras(SettingNode& node, bool has_one_camera) {
  std::vector<std::string> names = {"camera"};
  if (scene_) {
    names.clear();
    for (const berth::SceneCamera& camera : scene_->cameras) names.push_back(camera.name);
  }
  if (has_one_camera) {
    const std::string name = node.declare_parameter(
        "camera", names.front(), described("its name in the scene file and in messages"));
    return declare_camera(node, name, true);
  }
  names = node.declare_parameter(
      "cameras", names, described("names of the cameras: NAME/depth_image, NAME/camera_info"));
  if (names.empty() || names.size() > berth::kMostCameras) {
    throw std::invalid_argument("cameras: " + std::to_string(names.size()) + "; expected 1 to " +
                                std::to_string(berth::kMostCameras) + " names");
  }
  for (const std::string& name : names) declare_camera(node, name, false);
}

void NodeSettings::declare_camera(SettingNode& node, const std::string& name, bool has_one_camera) {
  CameraSettings camera;
  camera.settings = watched_camera();
  camera.name = name;
  camera.topic_prefix = has_one_camera ? "" : name + "/";
  if (scene_) {
    const auto found = std::find_if(scene_->cameras.begin(), scene_->cameras.end(),
                                    [&](const berth::SceneCamera& c) { return c.name == name; });
    if (found == scene_->cameras.end()) {
      throw std::invalid_argument("camera \"" + name + "\": " + scene_->file.string() +
                                  " has none of this name");
    }
    camera.units = {found->depth_scale_m, found->depth_offset_m, found->near_m, found->far_m};
    camera.is_rectified = found->is_rectified;
    camera.depth_is = found->depth_is;
    camera.live.clock_offset_s = found->clock_offset_s;
    camera.settings = found->settings;
    // The intrinsics are those of camera_info.
    camera.scene_mount = berth::CameraMount{{}, found->parent_link, found->X_PC};
  }
  // Of one camera the names have no prefix, of several that of the camera.
  const std::string prefix = has_one_camera ? "" : name + ".";
  const auto declare = [&](const std::string& key, auto& value, const std::string& sentence) {
    value = node.declare_parameter(prefix + key, value, described(sentence));
  };
  declare("image_transport", camera.image_transport,
          "raw, compressedDepth, or another transport that carries depth");
  camera.is_rectified = declare_rectified(node, prefix + "rectified", camera.is_rectified);
  std::string depth_is = camera.depth_is == berth::DepthIs::along_ray ? "ray" : "axis";
  declare(
      "depth_is", depth_is,
      "axis: a reading is the depth along the camera's axis; ray: the distance from the camera, "
      "as many simulators and time-of-flight cameras give it");
  camera.depth_is = depth_is_of(depth_is);
  if (has_one_camera && (camera.is_rectified == false || depth_is == "ray")) {
    throw std::invalid_argument(
        "rectified: false or depth_is: ray; expected rectified images of depths along the axis, "
        "since self_filter_node gives the images back as they came");
  }
  declare("depth_scale", camera.units.scale_m, "metres per unit of 16UC1 images");
  declare("depth_offset_m", camera.units.offset_m, "added to each reading, in metres");
  declare("near_m", camera.units.near_m, "nearer readings are none");
  declare("far_m", camera.units.far_m, "farther readings are none");
  declare("clock_offset_s", camera.live.clock_offset_s,
          "the joints' clock at an exposure is the image's stamp plus this");
  declare("max_wait_s", camera.live.max_wait_s,
          "how long an image waits for the joints and the transforms around its exposure");
  std::string reliability = "best_effort";
  declare("reliability", reliability,
          "how images and camera_info are asked for: best_effort, or reliable: then one that was "
          "lost on its way is sent again");
  camera.is_reliable = is_reliable_of(reliability);
  std::string poses = "auto";
  declare("camera_poses", poses,
          "where the camera's pose comes from: tf, scene, or auto: TF from when on it knows the "
          "camera, before that the scene file");
  camera.pose_source = pose_source_of(poses);
  if (camera.pose_source == PoseSource::scene && !camera.scene_mount) {
    throw std::invalid_argument("camera_poses: scene; expected a scene file");
  }
  if (!has_one_camera) {
    declare("filtered", camera.is_filtered,
            "the images come from a self_filter_node: their robot is taken out already");
    visit_setting_groups(camera.settings, [&](const std::string& group, const auto& settings) {
      declare_own_settings(node, prefix + group, setting_refs(settings), given_);
    });
  }
  cameras_.push_back(camera);
}

void NodeSettings::declare_separation(SettingNode& node) {
  const bool has_monitor = scene_ && scene_->separation;
  given_[kMonitor] = node.declare_parameter(
      kMonitor, rclcpp::ParameterValue(has_monitor),
      described("whether to tell how fast the robot may go on (separation, speed_scale)", false));
  const auto separation = has_monitor ? *scene_->separation : berth::SeparationSettings{};
  declare_settings(node, "separation", setting_refs(separation), given_);
}

void NodeSettings::declare_filter(SettingNode& node) {
  command_topic_ = node.declare_parameter(
      "filter.command_topic", "",
      described("where a controller takes its joint velocities, such as "
                "forward_velocity_controller/commands: of those that come as wanted_velocity it "
                "gets what keeps the robot away from what is near; empty: none are filtered"));
  if (command_topic_.empty()) return;
  filtered_joints_ = node.declare_parameter(
      "filter.joints", std::vector<std::string>(),
      described("the joints of the controller, in its order; the others are taken to stand; "
                "empty: all, in the order of the model"));
  const berth::VelocityFilterSettings filter;
  declare_settings(node, "filter", setting_refs(filter), given_);
}

std::optional<berth::VelocityFilterSettings> NodeSettings::filter_of(
    const GivenParameters& given) const {
  if (command_topic_.empty()) return {};
  berth::VelocityFilterSettings settings;
  apply_given(given, "filter", setting_refs(settings));
  return settings;
}

std::optional<berth::SeparationSettings> NodeSettings::separation_of(
    const GivenParameters& given) const {
  const auto monitor = given.find(kMonitor);
  if (monitor == given.end() || !monitor->second.get<bool>()) return {};
  berth::SeparationSettings settings =
      scene_ && scene_->separation ? *scene_->separation : berth::SeparationSettings{};
  apply_given(given, "separation", setting_refs(settings));
  return settings;
}

berth::EvaluationSettings NodeSettings::evaluation_of(const GivenParameters& given) const {
  berth::EvaluationSettings evaluation = scene_evaluation();
  evaluation.time = {};
  apply_given(given, "evaluation", setting_refs(evaluation));
  apply_given(given, "time", setting_refs(evaluation.time));
  return evaluation;
}

std::vector<CameraSettings> NodeSettings::cameras_of(const GivenParameters& given) const {
  std::vector<CameraSettings> cameras = cameras_;
  for (CameraSettings& camera : cameras) {
    visit_setting_groups(camera.settings, [&](const std::string& group, auto& settings) {
      apply_given(given, group, setting_refs(settings));
      apply_given(given, camera.name + "." + group, setting_refs(settings));
    });
    // A robot that was taken out cannot tell whether it is where it should be.
    if (camera.is_filtered) {
      camera.settings.watch.max_seen_through = 0;
      camera.settings.watch.max_displacement_m = 0;
      camera.settings.watch.min_at_robot = 0;
    }
  }
  return cameras;
}

bool NodeSettings::is_setting(const std::string& name) const {
  return std::any_of(kGroups.begin(), kGroups.end(), [&](const std::string& group) {
    if (name.rfind(group + ".", 0) == 0) return true;
    return std::any_of(cameras_.begin(), cameras_.end(), [&](const CameraSettings& camera) {
      return name.rfind(camera.name + "." + group + ".", 0) == 0;
    });
  });
}

GivenParameters NodeSettings::given() const {
  const std::lock_guard lock(given_mutex_);
  return given_;
}

GivenParameters NodeSettings::with(const std::vector<rclcpp::Parameter>& changes) const {
  GivenParameters given = this->given();
  for (const rclcpp::Parameter& change : changes) {
    if (is_setting(change.get_name())) given[change.get_name()] = change.get_parameter_value();
  }
  return given;
}

void NodeSettings::check(const std::vector<rclcpp::Parameter>& changes) const {
  const GivenParameters given = with(changes);
  const berth::EvaluationSettings evaluation = evaluation_of(given);
  berth::validate(evaluation.distance);
  berth::validate(evaluation.time);
  if (const auto separation = separation_of(given)) {
    berth::validate(*separation);
    if (!evaluation.visibility) {
      throw std::invalid_argument(
          "evaluation.visibility: false; expected true where separation.monitor is");
    }
  }
  if (const auto filter = filter_of(given)) visit_settings(*filter, berth::SettingCheck{"filter"});
  for (const CameraSettings& camera : cameras_of(given)) {
    berth::validate(camera.settings.self_filter);
    visit_setting_groups(camera.settings, [](const std::string& group, const auto& settings) {
      visit_settings(settings, berth::SettingCheck{group});
    });
  }
}

void NodeSettings::put_back(GivenParameters given) {
  const std::lock_guard lock(given_mutex_);
  given_.swap(given);
}

bool NodeSettings::take(const std::vector<rclcpp::Parameter>& changes) {
  put_back(with(changes));
  return std::any_of(changes.begin(), changes.end(), [&](const rclcpp::Parameter& change) {
    return is_setting(change.get_name());
  });
}

}  // namespace berth_ros
