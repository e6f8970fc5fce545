// Inside calibration/ only: a ball that is drawn into a camera's image.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "berth/calibration/detection_map.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth {

struct DrawnBall {
  Eigen::Vector3d center_C_m;
  double radius_m;
  /// Holds all pixels that show it.
  PixelRect pixels;
};

struct BallPlace {
  /// Whether a ball can be there: nothing that is read goes through it, and no robot is near.
  bool is_possible = true;
  /// None where the camera does not have all of it in its image, or sees less than half of it.
  std::optional<DrawnBall> ball = std::nullopt;
};

BallPlace ball_at(const Camera& camera, const DetectionImage& image,
                  const Eigen::Vector3d& center_B_m, double radius_m);

/// Into `drawn_m`, a copy of `sensed_m`: where it is nearer, with the noise and the dropouts that
/// are there.
void draw_ball(const Camera& camera, DepthView sensed_m, const DrawnBall& ball,
               DepthImage& drawn_m);

/// Whether any of its readings is left.
bool is_told(const DrawnBall& ball, DepthView sensed_m, DepthView drawn_m,
             const ObstacleImage& left);

/// Keeps balls so far apart in an image that no rule takes two for one thing.
class BallRoom {
 public:
  explicit BallRoom(const Camera& camera);

  /// Whether there is room for it; then there is none for another one.
  bool take(const Camera& camera, const DrawnBall& ball);

 private:
  Image<std::uint8_t> is_taken_;
};

}  // namespace berth
