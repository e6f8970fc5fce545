#include "berth/calibration/drawn_ball.hpp"

#include <cmath>

#include "berth/types/image.hpp"

namespace berth {
namespace {

constexpr double kRobotRoom_m = 0.08;
/// Readings of a surface are so exact at best.
constexpr double kThrough_m = 0.01;
constexpr double kBetweenBalls_m = 0.10;
constexpr int kTile_px = 8;
/// Of the depth: neighbours that are farther apart show no one surface.
constexpr float kOneSurface = 0.03F;

/// From the first to the last pixel whose centre the ball may cover, along one axis of the image.
std::pair<double, double> span_px(double x_m, double z_m, double radius_m, double f_px,
                                  double c_px) {
  const double middle_rad = std::atan2(x_m, z_m);
  const double half_rad = std::asin(radius_m / std::hypot(x_m, z_m));
  return {f_px * std::tan(middle_rad - half_rad) + c_px,
          f_px * std::tan(middle_rad + half_rad) + c_px};
}

PixelRect pixels_of(const Camera& camera, const Eigen::Vector3d& center_C_m, double radius_m) {
  const auto [u_first, u_last] =
      span_px(center_C_m.x(), center_C_m.z(), radius_m, camera.fx_px, camera.cx_px);
  const auto [v_first, v_last] =
      span_px(center_C_m.y(), center_C_m.z(), radius_m, camera.fy_px, camera.cy_px);
  return {static_cast<int>(std::floor(u_first)), static_cast<int>(std::floor(v_first)),
          static_cast<int>(std::ceil(u_last)) + 1, static_cast<int>(std::ceil(v_last)) + 1};
}

/// Where a pixel's ray enters the ball, and where it leaves it again; NaN where it misses it.
struct Chord {
  float front_m;
  float back_m;
};

Chord chord(const Camera& camera, const DrawnBall& ball, int u, int v) {
  const Eigen::Vector3d ray((u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px,
                            1);
  const double a = ray.squaredNorm(), b = ray.dot(ball.center_C_m);
  const double root =
      std::sqrt(b * b - a * (ball.center_C_m.squaredNorm() - ball.radius_m * ball.radius_m));
  return {static_cast<float>((b - root) / a), static_cast<float>((b + root) / a)};
}

/// Calls take(u, v, chord) for each pixel that shows the ball.
template <class Take>
void each_pixel(const Camera& camera, const DrawnBall& ball, const Take& take) {
  for (int v = ball.pixels.v_begin; v < ball.pixels.v_end; ++v) {
    for (int u = ball.pixels.u_begin; u < ball.pixels.u_end; ++u) {
      const Chord at = chord(camera, ball, u, v);
      if (!std::isnan(at.front_m)) take(u, v, at);
    }
  }
}

/// Whether a part of the robot that the camera sees is near, in the image and in depth.
bool is_near_robot(const Camera& camera, const RobotImage& robot, const DrawnBall& ball) {
  constexpr int kStep_px = 3;
  const double z_m = ball.center_C_m.z();
  const int room_px = static_cast<int>(std::ceil(camera.fx_px * kRobotRoom_m / z_m));
  const PixelRect near = clip(grown_by(ball.pixels, room_px), camera.width_px, camera.height_px);
  for (int v = near.v_begin; v < near.v_end; v += kStep_px) {
    for (int u = near.u_begin; u < near.u_end; u += kStep_px) {
      const LinkId id = robot.link_id(u, v);
      if (id == kNoLink || id == kEnvironmentLink) continue;
      if (std::abs(robot.depth_m(u, v) - z_m) < ball.radius_m + kRobotRoom_m) return true;
    }
  }
  return false;
}

/// What noise a reading has, by its neighbours; 0 where they show no one surface.
float noise_m(DepthView sensed_m, int u, int v) {
  if (u < 1 || v < 1 || u + 1 >= sensed_m.width || v + 1 >= sensed_m.height) return 0;
  const float z_m = sensed_m(u, v);
  float sum_m = 0;
  for (const float beside_m :
       {sensed_m(u - 1, v), sensed_m(u + 1, v), sensed_m(u, v - 1), sensed_m(u, v + 1)}) {
    if (!(std::abs(beside_m - z_m) < kOneSurface * z_m)) return 0;
    sum_m += beside_m;
  }
  return z_m - sum_m / 4;
}

/// Whether the sensor lost this pixel alone, and not all around it.
bool is_dropout(DepthView sensed_m, int u, int v) {
  if (!std::isnan(sensed_m(u, v))) return false;
  const PixelRect near = clip({u - 1, v - 1, u + 2, v + 2}, sensed_m.width, sensed_m.height);
  int read = 0, all = -1;
  for (int y = near.v_begin; y < near.v_end; ++y) {
    for (int x = near.u_begin; x < near.u_end; ++x) {
      ++all;
      read += !std::isnan(sensed_m(x, y));
    }
  }
  return 2 * read > all;
}

}  // namespace

BallPlace ball_at(const Camera& camera, const DetectionImage& image,
                  const Eigen::Vector3d& center_B_m, double radius_m) {
  const Eigen::Vector3d center_C_m = image.X_BC.inverse() * center_B_m;
  if (!(center_C_m.z() > 2 * radius_m)) return {};
  const DrawnBall ball{center_C_m, radius_m, pixels_of(camera, center_C_m, radius_m)};
  if (clip(ball.pixels, camera.width_px, camera.height_px) != ball.pixels) return {};
  if (is_near_robot(camera, image.robot, ball)) return {.is_possible = false};
  int pixels = 0, hidden = 0;
  bool is_possible = true;
  each_pixel(camera, ball, [&](int u, int v, const Chord& at) {
    ++pixels;
    const float z_m = std::fmin(image.depth_m(u, v), image.robot.depth_m(u, v));
    hidden += z_m < at.front_m;
    if (z_m > at.front_m + kThrough_m && z_m < at.back_m - kThrough_m) is_possible = false;
  });
  if (!is_possible) return {.is_possible = false};
  if (2 * hidden >= pixels && pixels > 0) return {};
  return {.ball = ball};
}

void draw_ball(const Camera& camera, DepthView sensed_m, const DrawnBall& ball,
               DepthImage& drawn_m) {
  each_pixel(camera, ball, [&](int u, int v, const Chord& at) {
    const float behind_m = sensed_m(u, v);
    if (behind_m < at.front_m || is_dropout(sensed_m, u, v)) return;
    const float nearer = std::isnan(behind_m) ? 0 : at.front_m / behind_m;
    drawn_m(u, v) = at.front_m + nearer * nearer * noise_m(sensed_m, u, v);
  });
}

bool is_told(const DrawnBall& ball, DepthView sensed_m, DepthView drawn_m,
             const ObstacleImage& left) {
  for (int v = ball.pixels.v_begin; v < ball.pixels.v_end; ++v) {
    for (int u = ball.pixels.u_begin; u < ball.pixels.u_end; ++u) {
      const bool is_drawn = !std::isnan(drawn_m(u, v)) && drawn_m(u, v) != sensed_m(u, v);
      if (is_drawn && is_kept(left.fate(u, v))) return true;
    }
  }
  return false;
}

BallRoom::BallRoom(const Camera& camera)
    : is_taken_(camera.width_px / kTile_px + 1, camera.height_px / kTile_px + 1, 0) {}

bool BallRoom::take(const Camera& camera, const DrawnBall& ball) {
  const double room_px = camera.fx_px * kBetweenBalls_m / 2 / ball.center_C_m.z();
  const PixelRect pixels =
      clip(grown_by(ball.pixels, static_cast<int>(room_px)), camera.width_px, camera.height_px);
  const auto each_tile = [&](const auto& is_good) {
    for (int v = pixels.v_begin / kTile_px; v <= (pixels.v_end - 1) / kTile_px; ++v) {
      for (int u = pixels.u_begin / kTile_px; u <= (pixels.u_end - 1) / kTile_px; ++u) {
        if (!is_good(is_taken_(u, v))) return false;
      }
    }
    return true;
  };
  if (!each_tile([](std::uint8_t is_taken) { return is_taken == 0; })) return false;
  return each_tile([](std::uint8_t& is_taken) {
    is_taken = 1;
    return true;
  });
}

}  // namespace berth
