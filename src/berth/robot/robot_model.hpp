// The robot as loaded from its URDF: constant, shared by all that use it.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "berth/robot/soft_body.hpp"
#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/guarded_box.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {
/// Which shapes of a URDF are the robot.
enum class GeometryKind {
  visual,     ///< the visual shapes, which the camera sees; a link without them has its collision
              ///< ones
  collision,  ///< the collision shapes; a link without them has its visual ones, since the camera
              ///< sees those
};
/// As in a URDF.
enum class JointType { fixed, revolute, continuous, prismatic };
/// What a link is to the filter and to requests.
enum class LinkRole {
  evaluated,    ///< filtered out of the image, and its distance is asked for
  environment,  ///< environment: filtered out, not evaluated
  ignored,      ///< neither
};

/// What connects a link to its parent. `X_PJ` is the joint's frame in the parent link's frame; the
/// link's own frame moves in it along or around `axis_J`.
struct Joint {
  std::string name;
  JointType type = JointType::fixed;
  Pose X_PJ = Pose::Identity();
  Eigen::Vector3d axis_J = Eigen::Vector3d::UnitX();
  /// Position = multiplier * JointState::position[position_index] + offset; a mimic joint has its
  /// master's index, a fixed one none.
  std::optional<std::size_t> position_index;
  double multiplier = 1;
  double offset = 0;
};

/// A rigid part of the robot, or environment that stands around it.
struct Link {
  std::string name;
  /// Index into RobotModel::links, always smaller than the link's own; none for the root.
  std::optional<std::size_t> parent;
  Joint joint;
  LinkRole role = LinkRole::ignored;
  /// 1, 2, ... for evaluated links, kEnvironmentLink for environment, else kNoLink.
  LinkId id = kNoLink;
  /// All of the link's shapes in its own frame L; empty for a link without geometry.
  TriangleMesh mesh_L;
};

/// One that a joint state has to give a position for.
struct MovableJoint {
  std::string name;
  JointType type = JointType::revolute;
  /// The URDF's limits, rad or m; nothing enforces them. A continuous joint has none.
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// rad/s or m/s; 0 where the URDF has none.
  double max_speed = 0;
};

/// Two links that may touch, by name: KnownPair leaves them out.
struct AllowedContact {
  std::string link;
  std::string other;
  /// Of `disable_collisions` in an SRDF, which may name links that the URDF has not.
  bool is_of_srdf = false;
};

/// The robot as its URDF describes it; constant once loaded.
struct RobotModel {
  std::string name;
  /// Parents before children; links[0] is the root, whose frame is B.
  std::vector<Link> links;
  /// The order of JointState::position; fixed and mimic joints are not among them.
  std::vector<MovableJoint> joints;
  /// Joints that follow another one: known by name, but nobody gives their position.
  std::vector<std::string> mimic_joints;
  /// evaluated_links[i] is the index in `links` of the link with the id i + 1.
  std::vector<std::size_t> evaluated_links;
  /// What hangs on it and bends (Attachment::is_soft).
  std::vector<SoftBody> soft_bodies = {};
  /// The boxes around the guarded links' shapes, along the links' axes.
  std::vector<GuardedBox> guarded = {};
  std::vector<AllowedContact> allowed_contacts = {};
  /// What was decided where a URDF or the settings leave it open; each says the file, the links or
  /// joint, what they are taken for, and how to have it otherwise.
  std::vector<std::string> warnings = {};

  int link_count() const { return static_cast<int>(evaluated_links.size()); }
  std::vector<std::string> evaluated_link_names() const;
  std::optional<std::size_t> find_link(std::string_view link_name) const;
  /// Whether a joint that moves lies between the root and links[index]. A link without one never
  /// moves; it is the base on its table, as a rule.
  bool is_moved(std::size_t index) const;
};

/// A second robot that stands on a link of the first one, with joints of its own. Its links and
/// joints are the robot's own from then on.
struct OtherRobot {
  std::filesystem::path urdf = {};
  std::map<std::string, std::filesystem::path> package_paths = {};
  /// Before the names of its links and joints: no two may be the same.
  std::string prefix = {};
  /// A link of the first robot, or of an other one before this in the list.
  std::string parent = {};
  /// Its root link's pose in the frame of that link.
  Pose X_PR = Pose::Identity();
};

/// Which robot, and what its links are to be.
struct RobotSettings {
  std::filesystem::path urdf = {};
  /// What package://NAME/ and model://NAME/ mean, and where a file: URL or an absolute path is
  /// looked for that passes a folder NAME and leads to no file. A NAME that is not here is looked
  /// for as a folder beside the URDF, then beside each folder above it; then as one whose
  /// package.xml says NAME.
  std::map<std::string, std::filesystem::path> package_paths = {};
  GeometryKind geometry = GeometryKind::visual;
  std::vector<std::string> environment_links = {};
  std::vector<std::string> ignore_links = {};
  /// Links that do not move and have shapes, whose boxes nobody can be in: no part of the robot
  /// either, and never in an image.
  std::vector<std::string> guarded_links = {};
  /// The URDF itself, where it comes from no file; `urdf` then is a name for messages, and the
  /// place that relative mesh paths begin at.
  std::optional<std::string> urdf_text = {};
  /// Pairs of links that may touch, by name.
  std::vector<std::array<std::string, 2>> allowed_contacts = {};
  /// The file whose `disable_collisions` name more of them; empty: none.
  std::filesystem::path srdf = {};
  /// Loaded with the same `geometry`.
  std::vector<OtherRobot> others = {};
};

/// Loads a URDF and its meshes. Evaluated are the links that have geometry and are neither
/// environment nor ignored; their ids follow the tree, parents first. Throws std::runtime_error
/// that names the file, the link or joint, the value and what was expected: URDF missing, invalid,
/// with a loop, without a root or with two, a floating or planar joint between links with shapes, a
/// mesh that is missing, unreadable or empty, an unknown link in the settings, a guarded one that
/// moves or has no shapes, an SRDF that is none, another robot with a name that there is already.
RobotModel load_robot(const RobotSettings& settings);

}  // namespace berth
