// What the request before says about the next one about the same space.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "berth/distance/link_search.hpp"
#include "berth/distance/settings.hpp"

namespace berth::mesh {

/// Where a link stood, and what both of its searches had found that nothing is nearer than.
struct LastLink {
  Pose X_BL = Pose::Identity();
  float reading_bound_m = 0;
  float nearest_bound_m = 0;
};

struct LastRequest {
  /// RobotPatches::serial_number and UnknownSpace::serial_number().
  std::uint64_t robot = 0;
  std::uint64_t space = 0;
  std::vector<LastLink> links;
};

/// All points of a link lie in this ball, in the link's frame.
struct LinkBall {
  Eigen::Vector3d centre_L_m;
  double radius_m;
};
LinkBall ball_of(const LinkPatches& link);

/// No point of the link has moved by more.
float moved_at_most_m(const LinkPatches& link, const Pose& X_BL_before, const Pose& X_BL);

/// Below it the roundings of bounds would keep a search from ending.
inline constexpr float kFinestTolerance_m = 2e-5f;

/// Begins a request about a link at X_BL. Pair and front stay as they are.
void start(const LinkPatches& patches, const Pose& X_BL, const MeshRequest& request,
           LinkSearch& search);

/// A front becomes finer and never coarser: from this number of items on it begins anew.
inline constexpr std::size_t kMostItems = std::size_t{1} << 14;

/// The pair of the request before is a pair of this one, too. Else there is none.
void keep_pair(LinkSearch& search);

/// Goes on with the front of the request before, since when the link has moved by `moved_m` at
/// most. Returns whether there is one that reaches far enough.
bool keep_front(float moved_m, LinkSearch& search);

}  // namespace berth::mesh
