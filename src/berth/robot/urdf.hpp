// Inside robot/ only.
#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>

#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"

namespace berth {

/// A URDF as it was written. Reading it throws std::runtime_error with file, line, link or joint,
/// element, value and what was expected.
struct Urdf {
  /// Refuses what is no XML, or no <robot>.
  Urdf(const std::filesystem::path& file, const std::string& xml);

  std::filesystem::path path;
  std::string text;
  pugi::xml_document document;

  pugi::xml_node robot() const { return document.document_element(); }
  /// The numbers that an element has as an attribute; `otherwise` where it has no such.
  double number(const pugi::xml_node& element, const char* attribute, double otherwise = 0) const;
  Eigen::Vector3d vector(const pugi::xml_node& element, const char* attribute,
                         const Eigen::Vector3d& otherwise) const;
  /// What <origin> in a joint or shape says: xyz, and rpy or the quat_xyzw of URDF 1.1.
  Pose origin_of(const pugi::xml_node& part) const;
  [[noreturn]] void fail(const pugi::xml_node& place, const std::string& what) const;

 private:
  Eigen::VectorXd numbers(const pugi::xml_node& element, const char* attribute, int count) const;
};

/// Links and joints without shapes and roles. Floating and planar joints are fixed ones. Throws as
/// Urdf does where they are no tree, or a mimic chain ends at no joint that moves.
RobotModel read_tree(const Urdf& urdf);

}  // namespace berth
