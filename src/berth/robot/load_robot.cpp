#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>

#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/robot/package_path.hpp"
#include "berth/robot/plausible_size.hpp"
#include "berth/robot/primitives.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/robot/urdf.hpp"

namespace berth {
namespace {

[[noreturn]] void fail(const RobotSettings& settings, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", settings.urdf.string(), what));
}

Pose to_pose(const urdf::Pose& pose) {
  Pose X;
  const Eigen::Quaterniond rotation(pose.rotation.w, pose.rotation.x, pose.rotation.y,
                                    pose.rotation.z);
  X.linear() = rotation.normalized().toRotationMatrix();
  X.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return X;
}

Eigen::Vector3d to_vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

/// Meshes that several links use are read once.
class MeshLoader {
 public:
  explicit MeshLoader(const RobotSettings& settings) : settings_(settings) {}

  /// The link's shapes in its frame.
  TriangleMesh load(const urdf::Link& link) {
    TriangleMesh mesh_L;
    for (const auto& [shape, X_LS] : shapes_of(link)) {
      try {
        append(*shape, X_LS, mesh_L);
      } catch (const std::runtime_error& error) {
        fail(settings_, fmt::format("link \"{}\": {}", link.name, error.what()));
      }
    }
    return mesh_L;
  }

 private:
  struct Shape {
    urdf::GeometrySharedPtr geometry;
    Pose X_LS;
  };

  std::vector<Shape> shapes_of(const urdf::Link& link) const {
    std::vector<Shape> visual;
    std::vector<Shape> collision;
    for (const auto& v : link.visual_array) visual.push_back({v->geometry, to_pose(v->origin)});
    for (const auto& c : link.collision_array)
      collision.push_back({c->geometry, to_pose(c->origin)});
    if (settings_.geometry == GeometryKind::collision && !collision.empty()) return collision;
    return visual;
  }

  static double positive(double value, const char* what) {
    if (!(value > 0))
      throw std::runtime_error(fmt::format("{} is {}; expected more than 0", what, value));
    return value;
  }

  void append(const urdf::Geometry& geometry, const Pose& X_LS, TriangleMesh& mesh_L) {
    const Eigen::Affine3d X(X_LS);
    if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(&geometry)) {
      const Eigen::Vector3d scale = to_vector(mesh->scale);
      if (!scale.allFinite() || (scale.array() == 0).any()) {
        throw std::runtime_error(
            fmt::format("mesh \"{}\": scale is {} {} {}; expected three numbers other than 0",
                        mesh->filename, scale.x(), scale.y(), scale.z()));
      }
      mesh_L.append(read(mesh->filename), X * Eigen::Scaling(scale));
    } else if (const auto* box = dynamic_cast<const urdf::Box*>(&geometry)) {
      positive(to_vector(box->dim).minCoeff(), "the box's least side");
      mesh_L.append(make_box(to_vector(box->dim)), X);
    } else if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(&geometry)) {
      mesh_L.append(make_cylinder(positive(cylinder->radius, "the cylinder's radius"),
                                  positive(cylinder->length, "the cylinder's length")),
                    X);
    } else if (const auto* sphere = dynamic_cast<const urdf::Sphere*>(&geometry)) {
      mesh_L.append(make_sphere(positive(sphere->radius, "the sphere's radius")), X);
    } else {
      throw std::runtime_error("a shape of unknown kind; expected mesh, box, cylinder or sphere");
    }
  }

  const TriangleMesh& read(const std::string& name) {
    const auto found = meshes_.find(name);
    if (found != meshes_.end()) return found->second;
    return meshes_
        .emplace(name,
                 read_mesh_file(resolve_mesh_path(name, settings_.urdf, settings_.package_paths)))
        .first->second;
  }

  const RobotSettings& settings_;
  std::map<std::string, TriangleMesh> meshes_;
};

JointType joint_type(const RobotSettings& settings, const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::FIXED:
      return JointType::fixed;
    case urdf::Joint::REVOLUTE:
      return JointType::revolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::continuous;
    case urdf::Joint::PRISMATIC:
      return JointType::prismatic;
    default:
      fail(settings,
           fmt::format(
               "joint \"{}\" is of a type without a single position (floating or planar); expected "
               "fixed, revolute, continuous or prismatic",
               joint.name));
  }
}

Joint to_joint(const RobotSettings& settings, const urdf::Joint& source) {
  Joint joint;
  joint.name = source.name;
  joint.type = joint_type(settings, source);
  joint.X_PJ = to_pose(source.parent_to_joint_origin_transform);
  if (joint.type == JointType::fixed) return joint;
  const Eigen::Vector3d axis = to_vector(source.axis);
  if (!(axis.norm() > 0) || !axis.allFinite()) {
    fail(settings, fmt::format("joint \"{}\": axis is {} {} {}; expected a vector other than 0",
                               source.name, axis.x(), axis.y(), axis.z()));
  }
  joint.axis_J = axis.normalized();
  return joint;
}

MovableJoint to_movable_joint(const Joint& joint, const urdf::Joint& source) {
  MovableJoint movable{joint.name, joint.type};
  if (joint.type == JointType::continuous || !source.limits) return movable;
  movable.lower = source.limits->lower;
  movable.upper = source.limits->upper;
  return movable;
}

/// Parents before children, so that one pass gives all poses.
void append_tree(const RobotSettings& settings, const urdf::Link& source,
                 std::optional<std::size_t> parent, RobotModel& model) {
  Link link;
  link.name = source.name;
  link.parent = parent;
  if (source.parent_joint) link.joint = to_joint(settings, *source.parent_joint);
  const std::size_t index = model.links.size();
  model.links.push_back(std::move(link));
  for (const auto& child : source.child_links) append_tree(settings, *child, index, model);
}

void number_joints(const urdf::ModelInterface& source, RobotModel& model) {
  std::map<std::string, std::size_t> index_of;
  for (const Link& link : model.links) {
    if (!link.parent || link.joint.type == JointType::fixed) continue;
    const urdf::JointConstSharedPtr joint = source.getJoint(link.joint.name);
    if (joint->mimic) {
      model.mimic_joints.push_back(link.joint.name);
      continue;
    }
    index_of[link.joint.name] = model.joints.size();
    model.joints.push_back(to_movable_joint(link.joint, *joint));
  }
  for (Link& link : model.links) {
    if (!link.parent || link.joint.type == JointType::fixed) continue;
    urdf::JointConstSharedPtr joint = source.getJoint(link.joint.name);
    for (; joint->mimic; joint = source.getJoint(joint->mimic->joint_name)) {
      link.joint.offset += link.joint.multiplier * joint->mimic->offset;
      link.joint.multiplier *= joint->mimic->multiplier;
    }
    link.joint.position_index = index_of.at(joint->name);
  }
}

void require_links(const RobotSettings& settings, const RobotModel& model,
                   const std::vector<std::string>& names, const char* setting) {
  for (const std::string& name : names) {
    if (model.find_link(name)) continue;
    std::vector<std::string> known;
    for (const Link& link : model.links) known.push_back(link.name);
    fail(settings, fmt::format("{}: no link \"{}\"; expected one of {}", setting, name,
                               fmt::join(known, ", ")));
  }
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Such a link moves with no joint, so that its pose is a product of fixed ones.
GuardedBox guarded_box(const RobotSettings& settings, const RobotModel& model, std::size_t index) {
  const Link& link = model.links[index];
  const Eigen::AlignedBox3d box_L_m = link.mesh_L.bounding_box_m().cast<double>();
  if (model.is_moved(index) || box_L_m.isEmpty()) {
    fail(settings, fmt::format("guarded_links: link \"{}\" {}; expected a link with shapes that no "
                               "joint moves",
                               link.name, box_L_m.isEmpty() ? "has no shapes" : "moves"));
  }
  Pose X_BL = Pose::Identity();
  for (std::optional<std::size_t> i = index; model.links[*i].parent; i = model.links[*i].parent) {
    X_BL = model.links[*i].joint.X_PJ * X_BL;
  }
  return {X_BL * Eigen::Translation3d(box_L_m.center()), box_L_m.sizes() / 2};
}

void assign_roles(const RobotSettings& settings, RobotModel& model) {
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    Link& link = model.links[i];
    if (contains(settings.guarded_links, link.name)) {
      model.guarded.push_back(guarded_box(settings, model, i));
      if (!contains(settings.environment_links, link.name)) link.mesh_L = {};
    }
    if (link.mesh_L.empty()) continue;
    if (contains(settings.environment_links, link.name)) {
      link.role = LinkRole::environment;
      link.id = kEnvironmentLink;
    } else {
      link.role = LinkRole::evaluated;
      model.evaluated_links.push_back(i);
      if (model.evaluated_links.size() >= kEnvironmentLink) fail(settings, "more links than 65534");
      link.id = static_cast<LinkId>(model.evaluated_links.size());
    }
  }
}

}  // namespace

std::vector<std::string> RobotModel::evaluated_link_names() const {
  std::vector<std::string> names;
  for (const std::size_t index : evaluated_links) names.push_back(links[index].name);
  return names;
}

std::optional<std::size_t> RobotModel::find_link(std::string_view link_name) const {
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].name == link_name) return i;
  }
  return std::nullopt;
}

bool RobotModel::is_moved(std::size_t index) const {
  for (std::optional<std::size_t> i = index; i; i = links[*i].parent) {
    if (links[*i].parent && links[*i].joint.type != JointType::fixed) return true;
  }
  return false;
}

RobotModel load_robot(const RobotSettings& settings) {
  const auto source = parse_urdf(
      settings.urdf, settings.urdf_text ? *settings.urdf_text : read_urdf(settings.urdf));
  RobotModel model;
  model.name = source->getName();
  append_tree(settings, *source->getRoot(), std::nullopt, model);
  number_joints(*source, model);
  require_links(settings, model, settings.environment_links, "environment_links");
  require_links(settings, model, settings.ignore_links, "ignore_links");
  require_links(settings, model, settings.guarded_links, "guarded_links");
  MeshLoader meshes(settings);
  for (Link& link : model.links) {
    if (!contains(settings.ignore_links, link.name))
      link.mesh_L = meshes.load(*source->getLink(link.name));
  }
  assign_roles(settings, model);
  require_plausible_size(settings.urdf, model);
  if (model.evaluated_links.empty()) {
    fail(settings, settings.geometry == GeometryKind::visual
                       ? "no link with geometry is left to evaluate; expected one at least with "
                         "visual shapes, or geometry: collision to take the collision shapes"
                       : "no link with geometry is left to evaluate; expected one at least");
  }
  return model;
}

}  // namespace berth
