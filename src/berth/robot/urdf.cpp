#include "berth/robot/urdf.hpp"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <urdf_parser/urdf_parser.h>

#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "berth/files/read_file.hpp"
#include "berth/files/xml.hpp"
#include "berth/robot/urdf_numbers.hpp"

namespace berth {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", path.string(), what));
}

// The log has one listener for the whole process.
std::mutex log_mutex;

/// urdfdom tells its errors to the log of the process alone: this listens while it parses.
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

void require_text(const std::filesystem::path& path, const std::string& text) {
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    refuse(path, "the URDF is empty; expected <robot>");
  if (text.find('\0') != std::string::npos)
    refuse(path, "the URDF holds a zero byte; expected UTF-8, not UTF-16");
}

constexpr const char* kExpected = "one <robot>, a tree of links, as in wiki.ros.org/urdf/XML";

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
        refuse(path, fmt::format("joint \"{}\" mimics \"{}\"; expected the name of a joint",
                                 current->name, master));
      }
      if (found->second->type == urdf::Joint::FIXED) {
        refuse(path, fmt::format(
                         "joint \"{}\" mimics \"{}\", which is fixed; expected a joint that moves",
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

/// urdfdom's own XML parser recurses, and takes the first of several shapes in silence.
void require_usable_xml(const std::filesystem::path& path, const std::string& text) {
  pugi::xml_document document;
  parse_xml(path, text, "not a valid URDF", document);
  const pugi::xml_node robot = document.document_element();
  if (std::string_view(robot.name()) != "robot")
    refuse(path, fmt::format("not a valid URDF: the root is <{}>; expected <robot>", robot.name()));
  require_urdf_numbers(path, text, robot);
  for (const pugi::xml_node& link : robot.children("link")) {
    for (const pugi::xml_node& part : link.children()) {
      const pugi::xml_node geometry = part.child("geometry");
      const auto shapes = geometry.select_nodes("*");
      if (shapes.size() <= 1) continue;
      throw std::runtime_error(fmt::format(
          "{}:{}: link \"{}\": <geometry> holds {} shapes; expected one", path.string(),
          line_of(text, geometry.offset_debug()), link.attribute("name").value(), shapes.size()));
    }
  }
}

}  // namespace

std::string read_urdf(const std::filesystem::path& path) { return read_file_bytes(path); }

urdf::ModelInterfaceSharedPtr parse_urdf(const std::filesystem::path& path,
                                         const std::string& text) {
  require_text(path, text);
  require_usable_xml(path, text);
  const auto model = parse(path, text);
  require_one_parent_each(path, *model);
  require_all_reached(path, *model);
  require_mimic_ends(path, *model);
  return model;
}

}  // namespace berth
