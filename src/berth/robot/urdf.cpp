#include "berth/robot/urdf.hpp"

#include <fmt/format.h>

#include <sstream>
#include <stdexcept>

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

}  // namespace berth
