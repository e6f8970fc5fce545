#pragma once

#include <Eigen/Core>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "berth/robot/triangle_mesh.hpp"

namespace berth {

/// The centre of a mesh's surface: the mean of its triangles' centres by their areas, so that it
/// does not depend on how the surface is cut into triangles, and lies inside a convex one. The
/// mean of the vertices where there is no area, 0 for a mesh without any.
Eigen::Vector3d surface_centre_m(const TriangleMesh& mesh);

/// The mesh, `scale` times as large in every dimension, about the centre of its surface.
TriangleMesh scaled(const TriangleMesh& mesh, double scale);

/// One normal for each vertex of length 1: the mean of those of the triangles that meet at its
/// position, by their areas. Outward where the mesh is wound counterclockwise as seen from outside;
/// 0 where the triangles cancel out.
std::vector<Eigen::Vector3f> vertex_normals(const TriangleMesh& mesh);

/// An enlarged robot, whose outline in the image is the robot-shaped region of surveillance
/// (Hirt 3.1.1). Each evaluated link is `scale` times as large in every direction, about the centre
/// of its own surface (surface_centre_m); it covers the link itself if that is convex. Environment
/// is left out.
RobotModel robot_region(const RobotModel& model, double scale);

}  // namespace berth
