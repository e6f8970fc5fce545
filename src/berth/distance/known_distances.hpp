#pragma once

#include <memory>
#include <vector>

#include "berth/distance/known_model.hpp"
#include "berth/distance/settings.hpp"
#include "berth/robot/kinematics.hpp"
#include "berth/types/closest_pair.hpp"

namespace berth {

/// The memory of known_distances(), made once and used for every request; one for each thread that
/// asks. What it remembers of a request still holds for the next one but for how far links moved.
class KnownWorkspace {
 public:
  KnownWorkspace();
  ~KnownWorkspace();
  KnownWorkspace(const KnownWorkspace&) = delete;
  KnownWorkspace& operator=(const KnownWorkspace&) = delete;

  /// The next request begins with nothing known.
  void forget();

 private:
  friend void known_distances(const KnownModel&, const RobotPose&, const MeshRequest&,
                              KnownWorkspace&, std::vector<KnownPair>&);
  struct State;
  std::unique_ptr<State> state_;
};

/// Per link that is asked about the least distance from its mesh to the environment's, the other
/// links' and other robots' meshes, by KnownModel::pairs; 0 where one is inside of the other, or
/// nearer than 20 um. out[i] is the link with the id i + 1. Always lower_bound_m <= true distance
/// <= distance_m, no farther apart than request.tolerance_m (20 um at least). Deadlines do not
/// apply. Allocates nothing once workspace and `out` have grown.
void known_distances(const KnownModel& known, const RobotPose& pose, const MeshRequest& request,
                     KnownWorkspace& workspace, std::vector<KnownPair>& out);

}  // namespace berth
