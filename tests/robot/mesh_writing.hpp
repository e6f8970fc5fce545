// Small mesh files as text and bytes.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace berth {

using Triangles = std::vector<std::array<Eigen::Vector3f, 3>>;

/// Two triangles whose bounding box is (0, 0, 0) to (1, 2, 3).
Triangles two_triangles();

/// `header` fills the first of the 80 header bytes.
std::string binary_stl(const Triangles& triangles, const std::string& header = "binary");
std::string text_stl(const Triangles& triangles);

struct DaeText {
  std::string unit = "";     ///< such as <unit meter="0.01"/>
  std::string up_axis = "";  ///< such as Y_UP
  /// The nodes of the visual scene. The geometry #shape is the triangle (0, 0, 0), (1, 0, 0),
  /// (0, 2, 3) and a corner (9, 9, 9) that no triangle uses.
  std::string nodes = R"(<node id="n"><instance_geometry url="#shape"/></node>)";
};
std::string dae(const DaeText& text);

}  // namespace berth
