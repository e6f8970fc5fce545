// What a real depth camera does to an ideal image, one effect at a time. All of them keep NaN (no
// reading) and depend on their arguments alone. Lengths that grow with the square of the depth, as
// those of stereo and structured light do, are given at 1 m.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/robot/robot_model.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "berth/types/joint_state.hpp"

namespace berth::sim {

/// Errors of an image; each 0 is off.
struct SensorErrors {
  double step_m_at_1m = 0;
  double noise_m_at_1m = 0;
  double dropout_share = 0;
  double mixed_share = 0;
  int outline_px = 0;
  bool operator==(const SensorErrors&) const = default;
};

/// Like a Kinect's.
inline constexpr SensorErrors kKinectErrors{.step_m_at_1m = 0.003,
                                            .noise_m_at_1m = 0.0015,
                                            .dropout_share = 0.02,
                                            .mixed_share = 0.1,
                                            .outline_px = 2};

/// Of a camera that reads nothing beside what stands out, nor here and there.
inline constexpr SensorErrors kDarkErrors{
    .noise_m_at_1m = 0.0015, .dropout_share = 0.02, .outline_px = 2};

/// All of them, by what follows.
void add_errors(const SensorErrors& errors, std::uint32_t seed, DepthImage& depth_m);

/// Much the same in one pass, for who takes thousands of images: of a pixel's neighbours only the
/// left and the upper one count, and outline_px has no effect.
void add_errors_quickly(const SensorErrors& errors, std::uint32_t seed, DepthImage& depth_m);

/// Whole steps of disparity: two neighbouring depths around z lie step_m_at_1m * z^2 apart.
void quantise(double step_m_at_1m, DepthImage& depth_m);

/// Gaussian noise of deviation deviation_m_at_1m * z^2, each pixel on its own.
void add_noise(double deviation_m_at_1m, std::uint32_t seed, DepthImage& depth_m);

/// Each pixel loses its reading with this probability.
void drop_out(double share, std::uint32_t seed, DepthImage& depth_m);

/// A pixel is at a depth edge if one of its eight neighbours is nearer by this part of its depth.
inline constexpr double kEdgeRatio = 0.03;

/// The nearest reading of a pixel and its eight neighbours, NaN where there is none.
float nearest_around_m(const DepthImage& depth_m, int u, int v);

/// Calls action(u, v, near_m) at the far side of each depth edge of `depth_m`.
template <class Action>
void at_far_sides(const DepthImage& depth_m, Action action) {
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const float near_m = nearest_around_m(depth_m, u, v);
      if (near_m < (1 - kEdgeRatio) * depth_m(u, v)) action(u, v, near_m);
    }
  }
}

/// Pixels on the far side of a depth edge get, with this probability, a depth between both sides.
void mix_edge_pixels(double share, std::uint32_t seed, DepthImage& depth_m);

/// Pixels on the far side of a depth edge, up to width_px away from it, lose their reading.
void darken_outlines(int width_px, DepthImage& depth_m);

/// The camera's pose as a bad calibration has it: moved by this length in a random direction, and
/// turned by this angle about a random axis.
Pose miscalibrated(const Pose& X_BC, double offset_m, double angle_rad, std::uint32_t seed);

/// Where the joints were delay_s ago, each moving at a random speed up to speed_per_s (rad/s; a
/// prismatic joint at up to a tenth of it in m/s). Within the limits.
JointState delayed(const RobotModel& model, const JointState& joints, double delay_s,
                   double speed_per_s, std::uint32_t seed);

}  // namespace berth::sim
