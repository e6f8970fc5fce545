#include "berth/robot/link_bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "berth/robot/kinematics.hpp"
#include "berth/robot/mesh_file/mesh_file.hpp"
#include "berth/robot/package_path.hpp"
#include "berth/robot/primitives.hpp"

namespace berth {
namespace {

// Bodies are drawn at 0.8 and 0.9 in places, zones and fields of view at 0.5 and less.
constexpr double kSeeThroughBelow = 0.75;

using Nodes = std::vector<pugi::xml_node>;
using Names = std::vector<std::string>;

Nodes children(const pugi::xml_node& link, const char* kind) {
  const auto found = link.children(kind);
  return {found.begin(), found.end()};
}

/// Meshes that several links use are read once.
class ShapeReader {
 public:
  ShapeReader(const RobotSettings& settings, const Urdf& urdf) : settings_(settings), urdf_(urdf) {}

  /// Appends <visual> or <collision>, in its link's frame.
  void append(const pugi::xml_node& shape, TriangleMesh& mesh_L) {
    const auto solids = shape.select_nodes("geometry/*");
    if (solids.size() != 1) {
      urdf_.fail(shape.child("geometry") ? shape.child("geometry") : shape,
                 fmt::format("<geometry> of a <{}> holds {} shapes; expected one box, cylinder, "
                             "sphere, capsule or mesh",
                             shape.name(), solids.size()));
    }
    const pugi::xml_node solid = solids.first().node();
    const Eigen::Affine3d X(urdf_.origin_of(shape));
    const std::string_view kind = solid.name();
    if (kind == "mesh") {
      const Eigen::Vector3d scale = urdf_.vector(solid, "scale", Eigen::Vector3d::Ones());
      require(solid, "scale", (scale.array() != 0).all(), "numbers other than 0");
      mesh_L.append(mesh_of(solid), X * Eigen::Scaling(scale));
    } else if (kind == "box") {
      const Eigen::Vector3d size = urdf_.vector(solid, "size", Eigen::Vector3d::Zero());
      require(solid, "size", size.minCoeff() > 0, "numbers above 0");
      mesh_L.append(make_box(size), X);
    } else if (kind == "sphere") {
      mesh_L.append(make_sphere(positive(solid, "radius")), X);
    } else if (kind == "cylinder") {
      mesh_L.append(make_cylinder(positive(solid, "radius"), positive(solid, "length")), X);
    } else if (kind == "capsule") {
      mesh_L.append(make_capsule(positive(solid, "radius"), positive(solid, "length")), X);
    } else {
      urdf_.fail(solid,
                 fmt::format("<{}> is a shape of unknown kind; expected mesh, box, cylinder, "
                             "sphere or capsule",
                             kind));
    }
  }

 private:
  void require(const pugi::xml_node& solid, const char* attribute, bool holds,
               const char* expected) const {
    if (holds) return;
    urdf_.fail(solid, fmt::format("<{}> has {}=\"{}\"; expected {}", solid.name(), attribute,
                                  solid.attribute(attribute).value(), expected));
  }

  double positive(const pugi::xml_node& solid, const char* attribute) const {
    const double value = urdf_.number(solid, attribute);
    require(solid, attribute, value > 0, "a number above 0");
    return value;
  }

  const TriangleMesh& mesh_of(const pugi::xml_node& solid) {
    const std::string name = solid.attribute("filename").value();
    if (const auto known = meshes_.find(name); known != meshes_.end()) return known->second;
    try {
      const auto file = resolve_mesh_path(name, settings_.urdf, settings_.package_paths);
      return meshes_.emplace(name, read_mesh_file(file)).first->second;
    } catch (const std::runtime_error& error) {
      urdf_.fail(solid, error.what());
    }
  }

  const RobotSettings& settings_;
  const Urdf& urdf_;
  std::map<std::string, TriangleMesh> meshes_;
};

/// Which shapes are bodies.
class Bodies {
 public:
  Bodies(const RobotSettings& settings, const Urdf& urdf, RobotModel& model)
      : settings_(settings), urdf_(urdf), model_(model) {
    for (const auto& color : urdf.robot().select_nodes("//material[@name!='']/color"))
      colors_.emplace(color.parent().attribute("name").value(), color.node());
    for (const pugi::xml_node& link : urdf.robot().children("link"))
      any_is_solid_ |= link.child("collision") || !solid(children(link, "visual")).empty();
  }

  void load() {
    ShapeReader reader(settings_, urdf_);
    for (Link& link : model_.links) {
      if (contains(settings_.ignore_links, link.name)) continue;
      for (const pugi::xml_node& shape : body_of(link.name)) reader.append(shape, link.mesh_L);
    }
    leave_out_hulls();
    warn(
        "see-through visual shapes (alpha below 0.75) are left out as zones, and are no part of "
        "the robot",
        helpers_, "if one is a real part, set its alpha to 1");
    warn("links without a visual shape are taken with their collision shape", unseen_,
         "ignore_links leaves them out");
    warn("collision shapes alone, around other links, are left out", hulls_,
         "visual shapes make them bodies");
  }

 private:
  Nodes solid(Nodes visual) const {
    std::erase_if(visual, [&](const pugi::xml_node& shape) {
      const pugi::xml_node material = shape.child("material");
      pugi::xml_node color = material.child("color");
      const auto named = colors_.find(material.attribute("name").value());
      if (!color && named != colors_.end()) color = named->second;
      std::istringstream rgba(color.attribute("rgba").value());
      double red, green, blue, alpha;
      return rgba >> red >> green >> blue >> alpha && alpha < kSeeThroughBelow;
    });
    return visual;
  }

  /// The settings say what it is.
  bool is_named(const std::string& link) const {
    return contains(settings_.environment_links, link) || contains(settings_.guarded_links, link);
  }

  Nodes body_of(const std::string& name) {
    const auto link = urdf_.robot().find_child_by_attribute("link", "name", name.c_str());
    const Nodes visual = children(link, "visual");
    const Nodes collision = children(link, "collision");
    if (visual.empty() && !collision.empty()) unseen_.push_back(name);
    if (visual.empty() || (settings_.geometry == GeometryKind::collision && !collision.empty()))
      return collision;
    const Nodes body = solid(visual);
    const bool may_be_helper = any_is_solid_ && !is_named(name);
    if (body.size() == visual.size() || !may_be_helper || (body.empty() && !collision.empty()))
      return visual;
    helpers_.push_back(name);
    return body;
  }

  void leave_out_hulls() {
    RobotPose pose;
    forward_kinematics(model_, std::vector<double>(model_.joints.size()), pose);
    for (const std::string& name : unseen_) {
      const std::size_t hull = *model_.find_link(name);
      const Eigen::AlignedBox3d box_H_m = model_.links[hull].mesh_L.bounding_box_m().cast<double>();
      bool is_hull = false;
      for (std::size_t i = 0; i < model_.links.size() && !is_named(name); ++i) {
        if (contains(unseen_, model_.links[i].name)) continue;
        is_hull |= holds(box_H_m, pose.X_BL[hull].inverse() * pose.X_BL[i], model_.links[i].mesh_L);
      }
      if (is_hull) hulls_.push_back(name);
    }
    for (const std::string& name : hulls_) {
      model_.links[*model_.find_link(name)].mesh_L = {};
      std::erase(unseen_, name);
    }
  }

  /// Most of a mesh, and not only something small.
  static bool holds(const Eigen::AlignedBox3d& box_H_m, const Pose& X_HL,
                    const TriangleMesh& mesh) {
    const auto inside = std::count_if(
        mesh.vertices_m.begin(), mesh.vertices_m.end(),
        [&](const auto& p_L_m) { return box_H_m.contains(X_HL * p_L_m.template cast<double>()); });
    return 2 * inside > std::ssize(mesh.vertices_m) &&
           2 * mesh.bounding_box_m().diagonal().norm() > box_H_m.diagonal().norm();
  }

  void warn(const char* what, const Names& links, const char* otherwise) {
    if (links.empty()) return;
    model_.warnings.push_back(fmt::format("{}: {}: {}; {}", settings_.urdf.string(), what,
                                          fmt::join(links, ", "), otherwise));
  }

  const RobotSettings& settings_;
  const Urdf& urdf_;
  RobotModel& model_;
  std::map<std::string, pugi::xml_node> colors_;
  /// Else the whole robot is drawn see-through.
  bool any_is_solid_ = false;
  Names helpers_;
  /// Of collision shapes alone.
  Names unseen_;
  Names hulls_;
};

}  // namespace

void load_bodies(const RobotSettings& settings, const Urdf& urdf, RobotModel& model) {
  Bodies(settings, urdf, model).load();
}

}  // namespace berth
