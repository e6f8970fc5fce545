// Distances between meshes, by FCL.
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>
#include <vector>

#include "lab/bundled_scene/mesh.hpp"
#include "lab/bundled_scene/ray_caster.hpp"

namespace berth::lab {

/// A mesh with its bounding-volume tree.
using DistanceModel = std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>>;

/// The tree of a mesh's triangles, or of those that are marked in `chosen` (one mark a triangle).
/// Null where there are none.
DistanceModel make_distance_model(const DrawnMesh& mesh);
DistanceModel make_distance_model(const DrawnMesh& mesh, const std::vector<bool>& chosen);

/// Models at their poses in the table's frame.
using DistanceObjects = std::vector<fcl::CollisionObjectd>;

/// models[i] at posed[i].X_TM.
DistanceObjects place(const std::vector<DistanceModel>& models,
                      const std::vector<PosedMesh>& posed);

/// The least distance of the model's surface, at X_TM, to that of any obstacle, in m.
double least_distance_m(const DistanceModel& model, const Pose& X_TM,
                        const DistanceObjects& obstacles);

}  // namespace berth::lab
