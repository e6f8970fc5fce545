#pragma once

#include <vector>

#include "thesis/image_request.hpp"
#include "thesis/link_distance.hpp"
#include "thesis/mean_direction/direction_sum.hpp"
#include "thesis/mean_direction/tile_means.hpp"

namespace berth {

/// The length of the difference between a mean direction and its definition, at most (a degree
/// where all directions agree; a hundredth of that is usual): pixels that lie close together and
/// far from the robot are taken as one.
inline constexpr float kMeanDirectionError = 0.017f;

/// The memory of fill_mean_directions(), made once and used for every request; one for each
/// thread. It carries nothing from one answer to the next.
struct DirectionWorkspace {
  TileMeans means;
  std::vector<DirectionSum> sums;
};

/// Fills mean_direction_C and mean_count of every link from its closest robot pixel (Hirt 2.2.5):
/// the mean of the unit vectors to every obstacle pixel in that pixel's region of surveillance, of
/// half side range_m, never shrunk. The region has no nearest depth, because of the gray area; its
/// farthest is the robot pixel's depth + range_m. A pair at distance 0 has no direction and does
/// not count. The count is exact, the direction within kMeanDirectionError. NaN and 0 for a link
/// that is not ok, or that nothing counts for. Allocates nothing once the workspace has grown to
/// the scene.
void fill_mean_directions(const ImageRequest& request, DirectionWorkspace& workspace,
                          LinkDistances& distances);

/// The minimum's magnitude with the mean's direction (Flacco), in frame C; NaN where either is
/// missing or the mean has no direction.
Eigen::Vector3f hybrid_vector_C_m(const LinkDistance& link);

}  // namespace berth
