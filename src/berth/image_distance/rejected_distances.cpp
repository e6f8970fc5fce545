#include "berth/image_distance/rejected_distances.hpp"

#include <cassert>
#include <limits>

namespace berth {

void find_rejected_distances(const Camera& camera, const RobotImage& robot,
                             const RejectedImage& rejected, const SearchableDepth& searchable,
                             const LinkDistances& distances, double range_m,
                             RejectedWorkspace& workspace, std::vector<LinkVisibility>& out) {
  assert(out.size() == distances.links.size());
  const bool has_any = !rejected.pixels.empty();
  if (has_any) {
    ImageDistanceSettings settings;
    settings.range_m = range_m;
    exact({camera, robot, static_cast<int>(out.size()), searchable, settings}, workspace.exact,
          workspace.distances);
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].rejected_distance_m = std::numeric_limits<float>::quiet_NaN();
    out[i].rejected_pixel = {};
    if (!has_any || workspace.distances.links[i].status != LinkStatus::ok) continue;
    const LinkDistance& kept = distances.links[i];
    const LinkDistance& dropped = workspace.distances.links[i];
    if (kept.status == LinkStatus::ok && kept.distance_m <= dropped.distance_m) continue;
    out[i].rejected_distance_m = dropped.distance_m;
    out[i].rejected_pixel = dropped.obstacle_pixel;
  }
}

}  // namespace berth
