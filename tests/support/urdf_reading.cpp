#include "tests/support/urdf_reading.hpp"

#include <tinyxml.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "tests/support/mesh_reading.hpp"

namespace berth {
namespace {

using Element = const TiXmlElement*;

Eigen::Vector3d three_numbers(Element element, const char* name, const Eigen::Vector3d& otherwise) {
  const char* text = element == nullptr ? nullptr : element->Attribute(name);
  if (text == nullptr) return otherwise;
  Eigen::Vector3d v;
  std::istringstream(text) >> v.x() >> v.y() >> v.z();
  return v;
}

double number(Element element, const char* name) { return std::stod(element->Attribute(name)); }

Eigen::Isometry3d read_origin(Element shape) {
  const Element origin = shape->FirstChildElement("origin");
  const Eigen::Vector3d rpy = three_numbers(origin, "rpy", Eigen::Vector3d::Zero());
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  X.translate(three_numbers(origin, "xyz", Eigen::Vector3d::Zero()));
  X.rotate(Eigen::AngleAxisd(rpy.z(), Eigen::Vector3d::UnitZ()));
  X.rotate(Eigen::AngleAxisd(rpy.y(), Eigen::Vector3d::UnitY()));
  X.rotate(Eigen::AngleAxisd(rpy.x(), Eigen::Vector3d::UnitX()));
  return X;
}

std::filesystem::path mesh_path(const std::filesystem::path& urdf, const std::string& name) {
  const std::string package = "package://";
  return urdf.parent_path() / (name.rfind(package, 0) == 0 ? name.substr(package.size()) : name);
}

void extend_by(LinkShapes& shapes, const Eigen::Vector3d& centre, const Eigen::Vector3d& half) {
  shapes.box_L_m.extend(centre - half);
  shapes.box_L_m.extend(centre + half);
}

void add_mesh(const std::filesystem::path& urdf, Element mesh, const Eigen::Isometry3d& X,
              LinkShapes& shapes) {
  const Eigen::Affine3d X_scaled =
      Eigen::Affine3d(X) * Eigen::Scaling(three_numbers(mesh, "scale", Eigen::Vector3d::Ones()));
  for (const auto& [a, b, c] : read_triangles(mesh_path(urdf, mesh->Attribute("filename")))) {
    const Eigen::Vector3d p = X_scaled * a;
    const Eigen::Vector3d q = X_scaled * b;
    const Eigen::Vector3d r = X_scaled * c;
    shapes.box_L_m.extend(p).extend(q).extend(r);
    shapes.flat_area_m2 += (q - p).cross(r - p).norm() / 2;
  }
}

void add_box(Element box, const Eigen::Isometry3d& X, LinkShapes& shapes) {
  const Eigen::Vector3d size = three_numbers(box, "size", Eigen::Vector3d::Zero());
  extend_by(shapes, X.translation(), X.linear().cwiseAbs() * size / 2);
  shapes.flat_area_m2 += 2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
}

void add_cylinder(Element cylinder, const Eigen::Isometry3d& X, LinkShapes& shapes) {
  const double radius = number(cylinder, "radius");
  const Eigen::Array3d axis = X.linear().col(2);
  const Eigen::Vector3d half =
      axis.abs() * number(cylinder, "length") / 2 + (1 - axis.square()).max(0).sqrt() * radius;
  extend_by(shapes, X.translation(), half);
  shapes.curved_radius_m = std::max(shapes.curved_radius_m, radius);
}

void add_sphere(Element sphere, const Eigen::Isometry3d& X, LinkShapes& shapes) {
  const double radius = number(sphere, "radius");
  extend_by(shapes, X.translation(), Eigen::Vector3d::Constant(radius));
  shapes.curved_radius_m = std::max(shapes.curved_radius_m, radius);
}

void add_shape(const std::filesystem::path& urdf, Element shape, LinkShapes& shapes) {
  const Eigen::Isometry3d X = read_origin(shape);
  const Element geometry = shape->FirstChildElement("geometry");
  if (Element mesh = geometry->FirstChildElement("mesh")) add_mesh(urdf, mesh, X, shapes);
  if (Element box = geometry->FirstChildElement("box")) add_box(box, X, shapes);
  if (Element cylinder = geometry->FirstChildElement("cylinder")) add_cylinder(cylinder, X, shapes);
  if (Element sphere = geometry->FirstChildElement("sphere")) add_sphere(sphere, X, shapes);
}

}  // namespace

std::map<std::string, LinkShapes> read_link_shapes(const std::filesystem::path& urdf,
                                                   const char* element) {
  TiXmlDocument document;
  if (!document.LoadFile(urdf.string()))
    throw std::runtime_error(urdf.string() + ": " + document.ErrorDesc());
  std::map<std::string, LinkShapes> links;
  const Element robot = document.RootElement();
  for (Element link = robot->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    LinkShapes& shapes = links[link->Attribute("name")];
    for (Element shape = link->FirstChildElement(element); shape != nullptr;
         shape = shape->NextSiblingElement(element)) {
      add_shape(urdf, shape, shapes);
    }
  }
  return links;
}

}  // namespace berth
