// True distances: mesh to mesh, by FCL.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "berth/robot/robot_model.hpp"

namespace berth::sim {

/// A mesh with its bounding-volume tree, in the mesh's own frame. Constant, shared by threads.
struct FclMesh;
using MeshTree = std::shared_ptr<const FclMesh>;

/// Null for an empty mesh.
MeshTree build_mesh_tree(const TriangleMesh& mesh);

/// [i] is the tree of model.links[i]; null for a link without geometry and an ignored one.
std::vector<MeshTree> build_link_trees(const RobotModel& model);

/// Two points of two surfaces in the frame that both poses are in. Infinite without surfaces.
struct SurfacePair {
  double distance_m = std::numeric_limits<double>::infinity();
  Eigen::Vector3d a_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::Vector3d b_m = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// The closest points of the surfaces of `a` at X_WA and `b` at X_WB, if they are closer than
/// `less_than_m`, else an infinite distance. Distance 0 where the surfaces meet; a mesh inside of
/// the other does not meet it.
SurfacePair closest_points(const MeshTree& a, const Pose& X_WA, const MeshTree& b, const Pose& X_WB,
                           double less_than_m = std::numeric_limits<double>::infinity());

}  // namespace berth::sim
