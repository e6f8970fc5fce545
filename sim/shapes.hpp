// The few ways to make a triangle mesh. Vertices are float because binary STL is: what is written
// to files is exactly what is rendered and measured. Triangles wind anticlockwise seen from
// outside.
#pragma once

#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"

namespace berth::sim {

/// A closed ring of points; all rings of one skin have the same number of points.
using Ring = std::vector<Eigen::Vector3d>;

/// A point of a lathe's outline.
struct ProfilePoint {
  double radius_m;
  double z_m;
};
using Profile = std::vector<ProfilePoint>;

/// Adds `part`, placed at X_AB, to `whole`, whose frame is A.
void append(TriangleMesh& whole, const TriangleMesh& part, const Pose& X_AB = Pose::Identity());

/// The surface between consecutive rings. Seen along the way from the first to the last ring, the
/// points of a ring run clockwise. Triangles without area (a ring may shrink to a point) are left
/// out.
TriangleMesh make_skin(const std::vector<Ring>& rings);

/// Turns the outline, from the lowest to the highest point, about z. `flatten` scales y.
TriangleMesh make_lathe(const Profile& profile, int segments, double flatten = 1.0);

/// A smooth outline through the given points (Catmull-Rom), `steps` per span.
Profile smooth_profile(const Profile& points, int steps);

/// A capsule from the origin to (0, 0, length), with the radii r0 and r1 at its ends.
TriangleMesh make_capsule(double length_m, double r0_m, double r1_m, int segments);

/// An ellipsoid around the origin with the given half axes.
TriangleMesh make_ellipsoid(const Eigen::Vector3d& half_axes_m, int segments);

/// A box around the origin with the given edge lengths.
TriangleMesh make_cuboid(const Eigen::Vector3d& size_m);

/// A pose without rotation.
Pose translation(double x_m, double y_m, double z_m);

/// A rotation about a unit axis, without translation.
Pose rotation(double angle_rad, const Eigen::Vector3d& axis);

}  // namespace berth::sim
