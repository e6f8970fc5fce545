#pragma once

#include <memory>
#include <vector>

#include "berth/distance/robot_patches.hpp"
#include "berth/distance/settings.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/space/unknown_space.hpp"
#include "berth/types/closest_pair.hpp"

namespace berth {

/// The memory of mesh_distances(), made once and used for every request; one for each thread that
/// asks. It remembers how far the last request had got: if the next one is about the same space
/// and robot, what was known then still holds but for how far each link has moved.
class MeshWorkspace {
 public:
  MeshWorkspace();
  ~MeshWorkspace();
  /// The copy goes on from the same request.
  MeshWorkspace(const MeshWorkspace& other);
  MeshWorkspace& operator=(const MeshWorkspace& other);
  MeshWorkspace(MeshWorkspace&&) noexcept;
  MeshWorkspace& operator=(MeshWorkspace&&) noexcept;

  /// The next request begins with nothing known.
  void forget();

 private:
  friend void mesh_distances(const RobotPatches&, const RobotPose&, const UnknownSpace&,
                             const MeshRequest&, MeshWorkspace&, std::vector<WholeLinkDistance>&);
  struct State;
  std::unique_ptr<State> state_;
};

/// Per link the least distance from all sides of its mesh to what the cameras of `space` saw or
/// could not see (`nearest`), and to what they saw alone (`reading`). out[i] is the link with the
/// id i + 1. Always lower_bound_m <= true distance <= distance_m; without a deadline both are no
/// farther apart than the tolerance (20 um at least), unless only cubes of 0.1 mm that may or may
/// not be hidden lie between. A link without triangles has no distance, and one beyond 50 m from B
/// no lower bound.
///
/// If `out` holds an answer on entry, its pairs are the first guess. Neither that nor what the
/// workspace remembers changes a distance by more than the tolerance; with a deadline, both bring
/// the bounds nearer together. Links are searched side by side on the threads that TBB has.
/// Allocates nothing once workspace and `out` have grown. Throws std::invalid_argument for bad
/// settings.
void mesh_distances(const RobotPatches& robot, const RobotPose& pose, const UnknownSpace& space,
                    const MeshRequest& request, MeshWorkspace& workspace,
                    std::vector<WholeLinkDistance>& out);

}  // namespace berth
