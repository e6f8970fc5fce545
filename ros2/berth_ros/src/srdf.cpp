#include "srdf.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <stdexcept>

namespace berth_ros {
namespace {

using tinyxml2::XMLElement;

/// Calls `take` with an attribute of all children of this kind.
template <class Take>
void each(const XMLElement& robot, const char* kind, const char* attribute, Take take) {
  for (const XMLElement* child = robot.FirstChildElement(kind); child != nullptr;
       child = child->NextSiblingElement(kind)) {
    if (const char* value = child->Attribute(attribute)) take(std::string(value));
  }
}

}  // namespace

std::vector<std::string> links_without_collisions(const std::string& srdf_file) {
  tinyxml2::XMLDocument document;
  const bool is_read = document.LoadFile(srdf_file.c_str()) == tinyxml2::XML_SUCCESS;
  const XMLElement* robot = is_read ? document.FirstChildElement("robot") : nullptr;
  if (robot == nullptr) {
    throw std::runtime_error(srdf_file + ": " +
                             (is_read ? "no <robot>; expected an SRDF" : document.ErrorStr()));
  }
  std::vector<std::string> links;
  each(*robot, "disable_default_collisions", "link",
       [&](const std::string& link) { links.push_back(link); });
  const auto keep = [&](const std::string& link) { std::erase(links, link); };
  each(*robot, "enable_collisions", "link1", keep);
  each(*robot, "enable_collisions", "link2", keep);
  return links;
}

}  // namespace berth_ros
