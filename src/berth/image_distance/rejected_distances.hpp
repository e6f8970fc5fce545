#pragma once

#include <vector>

#include "berth/image_distance/exact/exact.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/visibility/rejected.hpp"

namespace berth {

/// The memory of find_rejected_distances(), made once and used for every request; one for each
/// thread.
struct RejectedWorkspace {
  ExactWorkspace exact;
  LinkDistances distances;
};

/// Writes the rejected distance of out[i], the link with the id i + 1. `distances` are the answer
/// for `robot` within range_m; `searchable` is that of rejected.depth_m, with its tree. Allocates
/// nothing once the workspace has grown to the scene.
void find_rejected_distances(const Camera& camera, const RobotImage& robot,
                             const RejectedImage& rejected, const SearchableDepth& searchable,
                             const LinkDistances& distances, double range_m,
                             RejectedWorkspace& workspace, std::vector<LinkVisibility>& out);

}  // namespace berth
