// A second, independent reading of a URDF's geometry: see mesh_reading.hpp.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>

namespace berth {

/// One link's shapes in its own frame L.
struct LinkShapes {
  /// Around cylinders and spheres it is the exact box of the curved shape. Empty without shapes.
  Eigen::AlignedBox3d box_L_m;
  /// The area of all meshes and boxes.
  double flat_area_m2 = 0;
  /// The largest radius of the cylinders and spheres; 0 without any.
  double curved_radius_m = 0;
};

/// The shapes of every link by its name. `element` is "visual" or "collision"; package://NAME/...
/// is looked for in the URDF's folder. Throws std::runtime_error that names the file.
std::map<std::string, LinkShapes> read_link_shapes(const std::filesystem::path& urdf,
                                                   const char* element);

}  // namespace berth
