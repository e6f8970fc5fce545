#include "berth/distance/mean_direction/mean_direction.hpp"

#include <algorithm>
#include <limits>

#include "berth/distance/region_of_surveillance.hpp"

namespace berth {
namespace {

DirectionSum start_at(const Question& question, Pixel pixel) {
  const float depth_m = question.robot.depth_m(pixel.u, pixel.v);
  const double range_m = question.settings.range_m;
  return {static_cast<float>(pixel.u), static_cast<float>(pixel.v), depth_m,
          static_cast<float>(depth_m + range_m),
          region_of_surveillance(question.camera, pixel, depth_m, range_m)};
}

void fill(const DirectionSum& sum, LinkDistance& link) {
  if (sum.count == 0) return;
  link.mean_count = static_cast<std::int64_t>(sum.count);
  link.mean_direction_C = (Eigen::Vector3d(sum.x, sum.y, sum.z) / sum.count).cast<float>();
}

}  // namespace

void fill_mean_directions(const Question& question, DirectionWorkspace& workspace,
                          LinkDistances& distances) {
  validate(question.settings);
  workspace.sums.clear();
  for (LinkDistance& link : distances.links) {
    link.mean_direction_C.setConstant(std::numeric_limits<float>::quiet_NaN());
    link.mean_count = 0;
    if (link.status != LinkStatus::ok) continue;
    workspace.sums.push_back(start_at(question, link.robot_pixel));
  }
  if (workspace.sums.empty()) return;

  PixelRect rect;
  float max_depth_m = 0;
  for (const DirectionSum& sum : workspace.sums) {
    rect = united(rect, sum.rect);
    max_depth_m = std::max(max_depth_m, sum.max_depth_m);
  }
  build_direction_blocks(question.camera, question.obstacles, rect, max_depth_m, workspace.blocks);
  sum_directions(metric_of(question.camera), question.obstacles.depth_m(), workspace.blocks,
                 kMeanDirectionError, workspace.sums.data(),
                 static_cast<int>(workspace.sums.size()));
  auto sum = workspace.sums.begin();
  for (LinkDistance& link : distances.links) {
    if (link.status == LinkStatus::ok) fill(*sum++, link);
  }
}

Eigen::Vector3f hybrid_vector_C_m(const LinkDistance& link) {
  return link.mean_direction_C / link.mean_direction_C.norm() * link.distance_m;
}

}  // namespace berth
