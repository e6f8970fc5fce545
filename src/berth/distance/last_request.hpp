// What the request before says about the next one about the same space.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/distance/link_search.hpp"

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

/// No point of the link has moved by more.
float moved_at_most_m(const LinkPatches& link, const Pose& X_BL_before, const Pose& X_BL);

}  // namespace berth::mesh
