#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "berth/files/file_bytes.hpp"
#include "berth/files/xml.hpp"
#include "berth/robot/link_bodies.hpp"
#include "berth/robot/plausible_size.hpp"
#include "berth/robot/robot_model.hpp"
#include "berth/robot/urdf.hpp"

namespace berth {
namespace {

[[noreturn]] void fail(const RobotSettings& settings, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", settings.urdf.string(), what));
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

/// A floating or planar joint has no single position, and needs none where nothing with shapes is
/// on one of its sides, as between the world and a robot's base.
void require_no_free_part(const Urdf& urdf, RobotModel& model) {
  for (const pugi::xml_node& joint : urdf.robot().children("joint")) {
    const std::string_view type = joint.attribute("type").value();
    if (type != "floating" && type != "planar") continue;
    const std::string name = joint.attribute("name").value();
    std::vector<bool> is_below(model.links.size());
    std::array<std::vector<std::string>, 2> sides;
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const Link& link = model.links[i];
      is_below[i] = link.joint.name == name || (link.parent && is_below[*link.parent]);
      if (!link.mesh_L.empty()) sides[is_below[i]].push_back(link.name);
    }
    if (!sides[0].empty() && !sides[1].empty()) {
      urdf.fail(joint, fmt::format("{} joints have no single position, and links \"{}\" and \"{}\" "
                                   "beside it have shapes; expected fixed, revolute, continuous or "
                                   "prismatic, or all links of one side in ignore_links",
                                   type, sides[0].back(), sides[1].front()));
    }
    model.warnings.push_back(
        fmt::format("{}: joint \"{}\" is {}: taken as fixed where its origin is",
                    urdf.path.string(), name, type));
  }
}

/// Tree and shapes of the robot that the settings name, without others and roles.
RobotModel load_one_robot(const RobotSettings& settings) {
  const Urdf urdf(settings.urdf,
                  settings.urdf_text ? *settings.urdf_text : read_file_bytes(settings.urdf));
  RobotModel model = read_tree(urdf);
  load_bodies(settings, urdf, model);
  require_no_free_part(urdf, model);
  return model;
}

/// The names that begin with the prefix, without it.
std::vector<std::string> without_prefix(const std::vector<std::string>& names,
                                        const std::string& prefix) {
  std::vector<std::string> own;
  for (const std::string& name : names) {
    if (name.starts_with(prefix)) own.push_back(name.substr(prefix.size()));
  }
  return own;
}

RobotSettings settings_of(const OtherRobot& other, const RobotSettings& settings) {
  RobotSettings own;
  own.urdf = other.urdf;
  own.package_paths = other.package_paths;
  own.geometry = settings.geometry;
  own.environment_links = without_prefix(settings.environment_links, other.prefix);
  own.ignore_links = without_prefix(settings.ignore_links, other.prefix);
  own.guarded_links = without_prefix(settings.guarded_links, other.prefix);
  return own;
}

bool has_joint(const RobotModel& model, const std::string& name) {
  return std::ranges::find(model.joints, name, &MovableJoint::name) != model.joints.end();
}

void append(const OtherRobot& other, RobotModel loaded, RobotModel& model) {
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: others: {}", other.urdf.string(), what));
  };
  const auto parent = model.find_link(other.parent);
  if (!parent)
    fail(fmt::format("no link \"{}\" to stand on; expected one that there is", other.parent));
  const std::size_t links = model.links.size(), joints = model.joints.size();
  for (Link& link : loaded.links) {
    link.name = other.prefix + link.name;
    if (model.find_link(link.name)) {
      fail(fmt::format("a second link \"{}\"; expected names that differ (prefix)", link.name));
    }
    link.joint.name = other.prefix + (link.parent ? link.joint.name : "mount");
    if (!link.parent) link.joint.X_PJ = other.X_PR;
    link.parent = link.parent ? links + *link.parent : *parent;
    if (link.joint.position_index) *link.joint.position_index += joints;
    model.links.push_back(std::move(link));
  }
  for (MovableJoint& joint : loaded.joints) {
    joint.name = other.prefix + joint.name;
    if (has_joint(model, joint.name)) {
      fail(fmt::format("a second joint \"{}\"; expected names that differ (prefix)", joint.name));
    }
    model.joints.push_back(std::move(joint));
  }
  for (const std::string& name : loaded.mimic_joints) {
    model.mimic_joints.push_back(other.prefix + name);
  }
  model.warnings.insert(model.warnings.end(), loaded.warnings.begin(), loaded.warnings.end());
}

/// Loads RobotSettings::others, roles not yet given, and appends their links and joints to the
/// model. Throws std::runtime_error as load_robot does.
void append_other_robots(const RobotSettings& settings, RobotModel& model) {
  for (const OtherRobot& other : settings.others) {
    append(other, load_one_robot(settings_of(other, settings)), model);
  }
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
  std::vector<std::string> moving;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    Link& link = model.links[i];
    if (contains(settings.guarded_links, link.name)) {
      model.guarded.push_back(guarded_box(settings, model, i));
      if (!contains(settings.environment_links, link.name)) link.mesh_L = {};
    }
    if (link.mesh_L.empty()) continue;
    if (contains(settings.environment_links, link.name)) {
      if (model.is_moved(i)) moving.push_back(link.name);
      link.role = LinkRole::environment;
      link.id = kEnvironmentLink;
    } else {
      link.role = LinkRole::evaluated;
      model.evaluated_links.push_back(i);
      if (model.evaluated_links.size() >= kEnvironmentLink) fail(settings, "more links than 65534");
      link.id = static_cast<LinkId>(model.evaluated_links.size());
    }
  }
  if (moving.empty()) return;
  model.warnings.push_back(
      fmt::format("{}: environment_links: joints move {}, and nobody gets a distance of what is "
                  "environment; expected links that stand still",
                  settings.urdf.string(), fmt::join(moving, ", ")));
}

/// What an SRDF's `disable_collisions` name. Throws std::runtime_error that names file, line and
/// what was expected.
std::vector<AllowedContact> read_disabled_collisions(const std::filesystem::path& srdf) {
  const std::string text = read_file_bytes(srdf);
  pugi::xml_document document;
  parse_xml(srdf, text, "not a valid SRDF", document);
  const pugi::xml_node robot = document.document_element();
  const auto fail = [&](const pugi::xml_node& place, const std::string& what) {
    throw std::runtime_error(
        fmt::format("{}:{}: {}", srdf.string(), line_of(text, place.offset_debug()), what));
  };
  if (std::string_view(robot.name()) != "robot") {
    fail(robot, fmt::format("the root is <{}>; expected <robot>", robot.name()));
  }
  std::vector<AllowedContact> disabled;
  for (const pugi::xml_node& pair : robot.children("disable_collisions")) {
    const pugi::xml_attribute a = pair.attribute("link1"), b = pair.attribute("link2");
    if (!a || !b) fail(pair, "<disable_collisions> lacks a link; expected link1 and link2");
    disabled.push_back({a.value(), b.value(), true});
  }
  return disabled;
}

void append_allowed_contacts(const RobotSettings& settings, RobotModel& model) {
  for (const auto& [link, other] : settings.allowed_contacts) {
    require_links(settings, model, {link, other}, "allowed_contacts");
    model.allowed_contacts.push_back({link, other});
  }
  if (settings.srdf.empty()) return;
  const std::vector<AllowedContact> disabled = read_disabled_collisions(settings.srdf);
  model.allowed_contacts.insert(model.allowed_contacts.end(), disabled.begin(), disabled.end());
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
  RobotModel model = load_one_robot(settings);
  append_other_robots(settings, model);
  require_links(settings, model, settings.environment_links, "environment_links");
  require_links(settings, model, settings.ignore_links, "ignore_links");
  require_links(settings, model, settings.guarded_links, "guarded_links");
  append_allowed_contacts(settings, model);
  assign_roles(settings, model);
  require_plausible_size(settings.urdf, model);
  if (model.evaluated_links.empty())
    fail(settings, "no link with geometry is left to evaluate; expected one at least");
  return model;
}

}  // namespace berth
