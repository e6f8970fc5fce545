#include "berth/robot/urdf.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "berth/files/number.hpp"
#include "berth/files/xml.hpp"
#include "berth/types/pose.hpp"

namespace berth {

Urdf::Urdf(const std::filesystem::path& file, const std::string& xml) : path(file), text(xml) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw std::runtime_error(path.string() + ": the URDF is empty; expected <robot>");
  if (text.find('\0') != std::string::npos) {
    throw std::runtime_error(path.string() +
                             ": the URDF holds a zero byte; expected UTF-8, not UTF-16");
  }
  parse_xml(path, text, "not a valid URDF", document);
  if (std::string_view(robot().name()) != "robot") {
    fail(robot(),
         fmt::format("not a valid URDF: the root is <{}>; expected <robot>", robot().name()));
  }
}

void Urdf::fail(const pugi::xml_node& place, const std::string& what) const {
  pugi::xml_node part = place;
  while (part != robot() && part.parent() != robot()) part = part.parent();
  const std::string name =
      part == robot() ? ""
                      : fmt::format("{} \"{}\": ", part.name(), part.attribute("name").value());
  throw std::runtime_error(
      fmt::format("{}:{}: {}{}", path.string(), line_of(text, place.offset_debug()), name, what));
}

Eigen::VectorXd Urdf::numbers(const pugi::xml_node& element, const char* attribute,
                              int count) const {
  const char* const value = element.attribute(attribute).value();
  std::istringstream words(value);
  Eigen::VectorXd numbers(count);
  int found = 0;
  for (std::string word; words >> word; ++found) {
    const auto number = parse_finite(word);
    if (number && found < count) numbers[found] = *number;
    if (!number) found = count;
  }
  if (found == count) return numbers;
  fail(element, fmt::format("<{}> has {}=\"{}\"; expected {} finite number{}", element.name(),
                            attribute, value, count, count == 1 ? "" : "s"));
}

double Urdf::number(const pugi::xml_node& element, const char* attribute, double otherwise) const {
  return element.attribute(attribute) ? numbers(element, attribute, 1)[0] : otherwise;
}

Eigen::Vector3d Urdf::vector(const pugi::xml_node& element, const char* attribute,
                             const Eigen::Vector3d& otherwise) const {
  if (!element.attribute(attribute)) return otherwise;
  return numbers(element, attribute, 3);
}

Pose Urdf::origin_of(const pugi::xml_node& part) const {
  const pugi::xml_node origin = part.child("origin");
  const Eigen::Vector3d rpy = vector(origin, "rpy", Eigen::Vector3d::Zero());
  Eigen::Quaterniond rotation = rotation_of_rpy(rpy);
  if (origin.attribute("quat_xyzw")) {
    rotation = Eigen::Quaterniond(Eigen::Vector4d(numbers(origin, "quat_xyzw", 4)));
    if (!(rotation.norm() > 0) || origin.attribute("rpy"))
      fail(origin, "quat_xyzw is 0 or beside rpy; expected one rotation");
  }
  const Eigen::Vector3d xyz = vector(origin, "xyz", Eigen::Vector3d::Zero());
  return Eigen::Translation3d(xyz) * rotation.normalized();
}

namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

// The log has one listener for the whole process.
std::mutex log_mutex;

/// urdfdom reports its errors to the log of the process alone: this listens while it parses.
class LogListener : public console_bridge::OutputHandler {
 public:
  LogListener() : lock_(log_mutex) { console_bridge::useOutputHandler(this); }
  ~LogListener() override { console_bridge::restorePreviousOutputHandler(); }
  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level >= console_bridge::CONSOLE_BRIDGE_LOG_ERROR) errors_.push_back(text);
  }
  const std::vector<std::string>& errors() const { return errors_; }

 private:
  std::unique_lock<std::mutex> lock_;
  std::vector<std::string> errors_;
};

JointType type_of(const urdf::Joint& joint) {
  switch (joint.type) {
    case urdf::Joint::REVOLUTE:
      return JointType::revolute;
    case urdf::Joint::CONTINUOUS:
      return JointType::continuous;
    case urdf::Joint::PRISMATIC:
      return JointType::prismatic;
    default:
      return JointType::fixed;
  }
}

constexpr const char* kExpected = "one <robot>, a tree of links, as in wiki.ros.org/urdf/XML";

/// Names, types and mimics alone: numbers and shapes are read from the URDF itself, and what is
/// wrong with inertias, limits, materials or the version is nobody's loss.
std::string skeleton_of(const Urdf& urdf) {
  pugi::xml_document skeleton;
  pugi::xml_node robot = skeleton.append_child("robot");
  robot.append_copy(urdf.robot().attribute("name"));
  for (const pugi::xml_node& link : urdf.robot().children("link"))
    robot.append_child("link").append_copy(link.attribute("name"));
  for (const pugi::xml_node& joint : urdf.robot().children("joint")) {
    pugi::xml_node copy = robot.append_child("joint");
    for (const char* name : {"name", "type"}) copy.append_copy(joint.attribute(name));
    for (const char* name : {"parent", "child"}) copy.append_copy(joint.child(name));
    const bool is_fixed = std::string_view(joint.attribute("type").value()) == "fixed";
    const pugi::xml_node mimic = joint.child("mimic");
    if (mimic && !is_fixed) copy.append_child("mimic").append_copy(mimic.attribute("joint"));
    if (!joint.child("limit")) continue;
    pugi::xml_node limit = copy.append_child("limit");
    for (const char* name : {"effort", "velocity"}) limit.append_attribute(name) = 0;
  }
  std::ostringstream text;
  skeleton.save(text, "", pugi::format_raw);
  return text.str();
}

/// What urdfdom refuses in other words: it names neither line nor remedy.
void require_limits(const Urdf& urdf) {
  for (const pugi::xml_node& joint : urdf.robot().children("joint")) {
    const std::string_view type = joint.attribute("type").value();
    if ((type != "revolute" && type != "prismatic") || joint.child("limit")) continue;
    urdf.fail(joint, fmt::format("is {} and has no <limit>; expected <limit lower=\"\" upper=\"\" "
                                 "effort=\"\" velocity=\"\"/>, or the type continuous",
                                 type));
  }
}

void require_one_root(const Urdf& urdf) {
  std::set<std::string_view> children, roots;
  for (const pugi::xml_node& joint : urdf.robot().children("joint"))
    children.insert(joint.child("child").attribute("link").value());
  for (const pugi::xml_node& link : urdf.robot().children("link")) {
    if (const char* name = link.attribute("name").value(); !children.contains(name))
      roots.insert(name);
  }
  if (roots.size() < 2) return;
  urdf.fail(
      urdf.robot(),
      fmt::format("the links {} have no parent; expected one root: join them by fixed joints, "
                  "or leave out what is not needed",
                  fmt::join(roots, ", ")));
}

urdf::ModelInterfaceSharedPtr parse(const std::filesystem::path& path, const std::string& text) {
  LogListener log;
  urdf::ModelInterfaceSharedPtr model;
  try {
    model = urdf::parseURDF(text);
  } catch (const std::exception& error) {
    refuse(path, fmt::format("not a valid URDF: {}; expected {}", error.what(), kExpected));
  }
  if (!model || !log.errors().empty()) {
    refuse(path, fmt::format("not a valid URDF: {}; expected {}", fmt::join(log.errors(), "; "),
                             kExpected));
  }
  return model;
}

void require_one_parent_each(const std::filesystem::path& path, const urdf::ModelInterface& model) {
  std::map<std::string, std::string> parent_joint;
  for (const auto& [name, joint] : model.joints_) {
    const auto [entry, is_new] = parent_joint.emplace(joint->child_link_name, name);
    if (!is_new) {
      refuse(
          path,
          fmt::format(
              "link \"{}\" is the child of two joints, \"{}\" and \"{}\": a loop; expected a tree",
              joint->child_link_name, entry->second, name));
    }
  }
}

void require_all_reached(const std::filesystem::path& path, const urdf::ModelInterface& model) {
  std::set<std::string> reached{model.getRoot()->name};
  std::vector<urdf::LinkConstSharedPtr> open{model.getRoot()};
  while (!open.empty()) {
    const auto link = open.back();
    open.pop_back();
    for (const auto& child : link->child_links) {
      if (reached.insert(child->name).second) open.push_back(child);
    }
  }
  for (const auto& [name, link] : model.links_) {
    if (reached.count(name) == 0) {
      refuse(path, fmt::format("link \"{}\" is not connected to the root \"{}\" (its joints form a "
                               "loop); expected a tree",
                               name, model.getRoot()->name));
    }
  }
}

void require_mimic_ends(const std::filesystem::path& path, const urdf::ModelInterface& model) {
  for (const auto& [name, joint] : model.joints_) {
    std::set<std::string> seen{name};
    urdf::JointSharedPtr current = joint;
    while (current->mimic) {
      const std::string& master = current->mimic->joint_name;
      const auto found = model.joints_.find(master);
      if (found == model.joints_.end()) {
        refuse(path,
               fmt::format(
                   "joint \"{}\" mimics \"{}\", which there is not; expected the name of a joint",
                   current->name, master));
      }
      if (type_of(*found->second) == JointType::fixed) {
        refuse(path, fmt::format("joint \"{}\" mimics \"{}\", which is fixed, floating or planar; "
                                 "expected a joint that moves in one way",
                                 current->name, master));
      }
      if (!seen.insert(master).second) {
        refuse(path, fmt::format("joint \"{}\" mimics \"{}\", which follows it: a loop; expected a "
                                 "chain that ends",
                                 current->name, master));
      }
      current = found->second;
    }
  }
}

pugi::xml_node xml_of(const Urdf& urdf, const std::string& joint) {
  return urdf.robot().find_child_by_attribute("joint", "name", joint.c_str());
}

Joint to_joint(const Urdf& urdf, const urdf::Joint& source) {
  const pugi::xml_node xml = xml_of(urdf, source.name);
  Joint joint;
  joint.name = source.name;
  joint.type = type_of(source);
  joint.X_PJ = urdf.origin_of(xml);
  if (joint.type == JointType::fixed) return joint;
  const Eigen::Vector3d axis = urdf.vector(xml.child("axis"), "xyz", joint.axis_J);
  if (!(axis.norm() > 0)) urdf.fail(xml, "axis is 0 0 0; expected a direction");
  joint.axis_J = axis.normalized();
  return joint;
}

/// Parents before children, so that one pass gives all poses.
void append_tree(const Urdf& urdf, const urdf::Link& source, std::optional<std::size_t> parent,
                 RobotModel& model) {
  const std::size_t index = model.links.size();
  Link& link = model.links.emplace_back();
  link.name = source.name;
  link.parent = parent;
  if (source.parent_joint) link.joint = to_joint(urdf, *source.parent_joint);
  for (const auto& child : source.child_links) append_tree(urdf, *child, index, model);
}

MovableJoint to_movable_joint(const Urdf& urdf, const Joint& joint) {
  MovableJoint movable{joint.name, joint.type};
  const pugi::xml_node limit = xml_of(urdf, joint.name).child("limit");
  movable.max_speed = urdf.number(limit, "velocity", 0);
  if (joint.type == JointType::continuous) return movable;
  movable.lower = urdf.number(limit, "lower", 0);
  movable.upper = urdf.number(limit, "upper", 0);
  return movable;
}

void number_joints(const Urdf& urdf, const urdf::ModelInterface& tree, RobotModel& model) {
  std::map<std::string, std::size_t> index_of;
  for (const Link& link : model.links) {
    if (link.joint.type == JointType::fixed) continue;
    if (tree.getJoint(link.joint.name)->mimic) {
      model.mimic_joints.push_back(link.joint.name);
      continue;
    }
    index_of[link.joint.name] = model.joints.size();
    model.joints.push_back(to_movable_joint(urdf, link.joint));
  }
  for (Link& link : model.links) {
    if (link.joint.type == JointType::fixed) continue;
    urdf::JointConstSharedPtr joint = tree.getJoint(link.joint.name);
    for (; joint->mimic; joint = tree.getJoint(joint->mimic->joint_name)) {
      const pugi::xml_node mimic = xml_of(urdf, joint->name).child("mimic");
      link.joint.offset += link.joint.multiplier * urdf.number(mimic, "offset", 0);
      link.joint.multiplier *= urdf.number(mimic, "multiplier", 1);
    }
    link.joint.position_index = index_of.at(joint->name);
  }
}

}  // namespace

RobotModel read_tree(const Urdf& urdf) {
  require_limits(urdf);
  require_one_root(urdf);
  const urdf::ModelInterfaceSharedPtr tree = parse(urdf.path, skeleton_of(urdf));
  require_one_parent_each(urdf.path, *tree);
  require_all_reached(urdf.path, *tree);
  require_mimic_ends(urdf.path, *tree);
  RobotModel model;
  model.name = tree->getName();
  append_tree(urdf, *tree->getRoot(), std::nullopt, model);
  number_joints(urdf, *tree, model);
  return model;
}

}  // namespace berth
