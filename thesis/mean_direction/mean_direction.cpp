#include "thesis/mean_direction/mean_direction.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "thesis/region_of_surveillance.hpp"

namespace berth {
namespace {

DirectionSum start_at(const ImageRequest& request, Pixel pixel) {
  const float depth_m = request.robot.depth_m(pixel.u, pixel.v);
  const double range_m = request.settings.range_m;
  return {static_cast<float>(pixel.u), static_cast<float>(pixel.v), depth_m,
          static_cast<float>(depth_m + range_m),
          region_of_surveillance(request.camera, pixel, depth_m, range_m)};
}

void fill(const DirectionSum& sum, LinkDistance& link) {
  if (sum.count == 0) return;
  link.mean_count = sum.count;
  link.mean_direction_C =
      (Eigen::Vector3d(sum.x, sum.y, sum.z) / static_cast<double>(sum.count)).cast<float>();
}

}  // namespace

void fill_mean_directions(const ImageRequest& request, DirectionWorkspace& workspace,
                          LinkDistances& distances) {
  validate(request.settings);
  workspace.sums.clear();
  PixelRect rect;
  float max_depth_m = 0;
  for (LinkDistance& link : distances.links) {
    link.mean_direction_C.setConstant(std::numeric_limits<float>::quiet_NaN());
    link.mean_count = 0;
    if (link.status != LinkStatus::ok) continue;
    workspace.sums.push_back(start_at(request, link.robot_pixel));
    rect = united(rect, workspace.sums.back().rect);
    max_depth_m = std::max(max_depth_m, workspace.sums.back().max_depth_m);
  }
  if (workspace.sums.empty()) return;

  build_tile_means(request.camera, request.obstacles, rect, max_depth_m, workspace.means);
  const Metric metric = metric_of(request.camera);
  tbb::parallel_for(std::size_t{0}, workspace.sums.size(), [&](std::size_t i) {
    add_directions(metric, request.obstacles, workspace.means, workspace.sums[i]);
  });
  auto sum = workspace.sums.begin();
  for (LinkDistance& link : distances.links) {
    if (link.status == LinkStatus::ok) fill(*sum++, link);
  }
}

Eigen::Vector3f hybrid_vector_C_m(const LinkDistance& link) {
  return link.mean_direction_C / link.mean_direction_C.norm() * link.distance_m;
}

}  // namespace berth
