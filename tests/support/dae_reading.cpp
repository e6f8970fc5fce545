#include "tests/support/dae_reading.hpp"

#include <tinyxml.h>

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace berth {
namespace {

using Element = const TiXmlElement*;

void for_each_child(Element parent, const char* name, const std::function<void(Element)>& visit) {
  if (parent == nullptr) return;
  for (Element e = parent->FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name))
    visit(e);
}

std::string attribute(Element element, const char* name) {
  const char* value = element->Attribute(name);
  return value == nullptr ? "" : value;
}

/// What a reference such as "#shape" points to.
std::string target(Element element, const char* name) { return attribute(element, name).substr(1); }

template <typename T>
std::vector<T> numbers_in(Element element) {
  std::vector<T> numbers;
  std::istringstream words(element->GetText() == nullptr ? "" : element->GetText());
  for (T number; words >> number;) numbers.push_back(number);
  return numbers;
}

class DaeReader {
 public:
  explicit DaeReader(const std::filesystem::path& path) : path_(path) {
    if (!document_.LoadFile(path.string())) throw fail(document_.ErrorDesc());
    root_ = document_.RootElement();
  }

  TriangleSoup read() {
    for_each_child(root_->FirstChildElement("library_geometries"), "geometry",
                   [&](Element geometry) {
                     geometries_[attribute(geometry, "id")] = read_geometry(geometry);
                   });
    TriangleSoup soup;
    for_each_child(root_->FirstChildElement("library_visual_scenes"), "visual_scene",
                   [&](Element scene) { append_children(scene, Eigen::Affine3d(unit()), soup); });
    return soup;
  }

 private:
  std::runtime_error fail(const std::string& what) const {
    return std::runtime_error(path_.string() + ": " + what);
  }

  Eigen::UniformScaling<double> unit() const {
    double meter = 1;
    if (Element asset = root_->FirstChildElement("asset")) {
      if (Element unit = asset->FirstChildElement("unit"))
        unit->QueryDoubleAttribute("meter", &meter);
    }
    return Eigen::Scaling(meter);
  }

  TriangleSoup read_geometry(Element geometry) const {
    TriangleSoup soup;
    Element mesh = geometry->FirstChildElement("mesh");
    for (const char* kind : {"triangles", "polylist", "polygons"}) {
      for_each_child(mesh, kind, [&](Element primitive) { append(mesh, primitive, soup); });
    }
    return soup;
  }

  std::vector<double> positions(Element mesh, const std::string& vertices_id) const {
    std::string source_id;
    for_each_child(mesh, "vertices", [&](Element vertices) {
      if (attribute(vertices, "id") != vertices_id) return;
      for_each_child(vertices, "input", [&](Element input) {
        if (attribute(input, "semantic") == "POSITION") source_id = target(input, "source");
      });
    });
    std::vector<double> numbers;
    for_each_child(mesh, "source", [&](Element source) {
      if (attribute(source, "id") == source_id)
        numbers = numbers_in<double>(source->FirstChildElement("float_array"));
    });
    if (numbers.empty()) throw fail("no positions \"" + vertices_id + "\"");
    return numbers;
  }

  void append(Element mesh, Element primitive, TriangleSoup& soup) const {
    std::size_t stride = 0;
    std::size_t vertex_offset = 0;
    std::vector<double> xyz;
    for_each_child(primitive, "input", [&](Element input) {
      const std::size_t offset = std::stoul(attribute(input, "offset"));
      stride = std::max(stride, offset + 1);
      if (attribute(input, "semantic") != "VERTEX") return;
      vertex_offset = offset;
      xyz = positions(mesh, target(input, "source"));
    });
    std::vector<std::size_t> corners;
    if (Element counts = primitive->FirstChildElement("vcount"))
      corners = numbers_in<std::size_t>(counts);
    for_each_child(primitive, "p", [&](Element p) {
      const auto indices = numbers_in<std::size_t>(p);
      std::vector<std::size_t> sizes = corners;
      if (primitive->ValueStr() == "polygons") sizes = {indices.size() / stride};
      if (primitive->ValueStr() == "triangles") sizes.assign(indices.size() / stride / 3, 3);
      std::size_t next = vertex_offset;
      for (const std::size_t size : sizes) {
        std::vector<Eigen::Vector3d> polygon;
        for (std::size_t i = 0; i < size; ++i, next += stride) {
          const std::size_t first = 3 * indices.at(next);
          polygon.emplace_back(xyz.at(first), xyz.at(first + 1), xyz.at(first + 2));
        }
        append_fan(polygon, soup);
      }
    });
  }

  void append_children(Element parent, const Eigen::Affine3d& X, TriangleSoup& soup) const {
    for_each_child(parent, "node",
                   [&](Element node) { append_node(node, X * transform(node), soup); });
  }

  void append_node(Element node, const Eigen::Affine3d& X, TriangleSoup& soup) const {
    for (const char* unknown : {"instance_node", "instance_controller"}) {
      if (node->FirstChildElement(unknown) != nullptr) throw fail(unknown);
    }
    for_each_child(node, "instance_geometry", [&](Element instance) {
      for (auto triangle : geometries_.at(target(instance, "url"))) {
        for (Eigen::Vector3d& corner : triangle) corner = X * corner;
        soup.push_back(triangle);
      }
    });
    append_children(node, X, soup);
  }

  /// The node's transforms act in the order in which they stand.
  Eigen::Affine3d transform(Element node) const {
    Eigen::Affine3d X = Eigen::Affine3d::Identity();
    for (Element e = node->FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      const std::string& kind = e->ValueStr();
      const auto n = numbers_in<double>(e);
      if (kind == "matrix") {
        X = X * Eigen::Affine3d(
                    Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(n.data()));
      } else if (kind == "translate") {
        X.translate(Eigen::Vector3d(n.at(0), n.at(1), n.at(2)));
      } else if (kind == "scale") {
        X.scale(Eigen::Vector3d(n.at(0), n.at(1), n.at(2)));
      } else if (kind == "rotate") {
        X.rotate(Eigen::AngleAxisd(n.at(3) * std::numbers::pi / 180,
                                   Eigen::Vector3d(n.at(0), n.at(1), n.at(2)).normalized()));
      } else if (kind == "skew" || kind == "lookat") {
        throw fail(kind);
      }
    }
    return X;
  }

  std::filesystem::path path_;
  TiXmlDocument document_;
  Element root_ = nullptr;
  std::map<std::string, TriangleSoup> geometries_;
};

}  // namespace

TriangleSoup read_dae(const std::filesystem::path& path) { return DaeReader(path).read(); }

}  // namespace berth
