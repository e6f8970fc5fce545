#include "tests/robot/mesh_writing.hpp"

#include <cstdint>
#include <sstream>

namespace berth {
namespace {

template <typename T>
void append_bytes(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

Triangles two_triangles() {
  return {{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1, 0, 0), Eigen::Vector3f(0, 2, 0)},
          {Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, 2, 0), Eigen::Vector3f(0, 0, 3)}};
}

std::string binary_stl(const Triangles& triangles, const std::string& header) {
  std::string bytes = header;
  bytes.resize(80, ' ');
  append_bytes(bytes, static_cast<std::uint32_t>(triangles.size()));
  for (const auto& triangle : triangles) {
    append_bytes(bytes, std::array<float, 3>{0, 0, 1});
    for (const Eigen::Vector3f& corner : triangle)
      append_bytes(bytes, std::array<float, 3>{corner.x(), corner.y(), corner.z()});
    append_bytes(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string text_stl(const Triangles& triangles) {
  std::ostringstream text;
  text << "solid part\n";
  for (const auto& triangle : triangles) {
    text << "facet normal 0 0 1\n outer loop\n";
    for (const Eigen::Vector3f& corner : triangle)
      text << "  vertex " << corner.x() << " " << corner.y() << " " << corner.z() << "\n";
    text << " endloop\nendfacet\n";
  }
  text << "endsolid part\n";
  return text.str();
}

std::string dae(const DaeText& text) {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset>)" +
         text.unit + (text.up_axis.empty() ? "" : "<up_axis>" + text.up_axis + "</up_axis>") +
         R"(</asset>
<library_geometries><geometry id="shape"><mesh>
<source id="positions"><float_array id="array" count="12">0 0 0 1 0 0 0 2 3 9 9 9</float_array>
<technique_common><accessor count="4" source="#array" stride="3">
<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
</accessor></technique_common></source>
<vertices id="vertices"><input semantic="POSITION" source="#positions"/></vertices>
<triangles count="1"><input offset="0" semantic="VERTEX" source="#vertices"/><p>0 1 2</p></triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="scene">)" +
         text.nodes + R"(</visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#scene"/></scene></COLLADA>)";
}

}  // namespace berth
