// The true distances that belong to the scene.
#pragma once

#include <string>
#include <vector>

#include "lab/bundled_scene/scene.hpp"
#include "sim/mesh_distance.hpp"

namespace berth::lab {

/// The true distances of one link to all obstacle meshes in one frame, in m.
struct TruthRow {
  int frame;
  std::string link;
  double whole_m;  ///< of the whole visual mesh
  double seen_m;   ///< of its triangles that the camera sees; NaN where it sees none
};

struct TruthTrees {
  std::vector<sim::MeshTree> links;
  std::vector<sim::MeshTree> obstacles;
};
TruthTrees build_truth_trees(const Scene& scene);

/// `robot_alone` shows posed.robot without the obstacles: a link is seen where a pixel of it is in
/// the robot depth image, whether an obstacle stands before it or not. Throws std::runtime_error
/// where an obstacle is nearer than 2 cm: the scene is to stay free of contact.
std::vector<TruthRow> measure_truth(int frame, const PosedScene& posed, const TruthTrees& trees,
                                    const Image<sim::SurfaceHit>& robot_alone);

}  // namespace berth::lab
