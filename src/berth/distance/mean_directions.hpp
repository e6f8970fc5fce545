// The mean direction of what is near a link's closest point (Hirt 2.2.5), in space.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth {

/// The readings of an obstacle image by tiles of 8 x 8 pixels, those without readings left out. In
/// the optical frame C, metres; padded with empty tiles to a multiple of 16.
struct ReadingTiles {
  static constexpr int kTilePx = 8;

  std::vector<float> count;
  /// The mean of the tile's points, and the radius of a ball around it that holds them all.
  std::vector<float> x_m;
  std::vector<float> y_m;
  std::vector<float> z_m;
  std::vector<float> radius_m;
  /// The tile's first pixel.
  std::vector<Pixel> corner;
};

/// Writes `out`, whose memory it reuses.
void build_reading_tiles(const Camera& camera, DepthView obstacle_depth_m, ReadingTiles& out);

/// One camera's readings for mean_direction().
struct DirectionCamera {
  const Camera& camera;
  DepthView obstacle_depth_m;
  const ReadingTiles& tiles;
  Pose X_BC;
};

/// The mean of the unit vectors from a point to the readings around it, in frame B.
struct MeanDirection {
  /// Its length is at most 1; NaN where the count is 0.
  Eigen::Vector3f direction_B;
  std::int64_t count = 0;
};

/// Of all readings within range_m of p_B. A tile counts as one, by its mean, where the ball around
/// it has a radius of at most a quarter of its distance: the mean direction is wrong by 0.04 at
/// most, two degrees, and by far less in real images. A nearer tile goes pixel by pixel. A reading
/// at p_B has no direction and does not count.
MeanDirection mean_direction(std::span<const DirectionCamera> views, const Eigen::Vector3d& p_B_m,
                             double range_m);

}  // namespace berth
