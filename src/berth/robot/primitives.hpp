#pragma once

#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// Flat faces around a curved shape stand off its surface by at most this share of its radius. They
/// lie outside of it, never inside, so that a distance to the mesh is never larger than one to the
/// shape.
inline constexpr double kMaxPrimitiveExcess = 0.0045;

/// The shapes of URDF, in metres, centred at the origin; a cylinder's axis is z.
TriangleMesh make_box(const Eigen::Vector3d& size_m);
TriangleMesh make_cylinder(double radius_m, double length_m);  ///< along z
TriangleMesh make_sphere(double radius_m);                     ///< as the others
/// Along z; its length is that between the centres of its caps.
TriangleMesh make_capsule(double radius_m, double length_m);

}  // namespace berth
