#include "sim/sensor_model.hpp"

#include <algorithm>
#include <cmath>

#include "sim/drawn_obstacles.hpp"
#include "sim/random.hpp"

namespace berth::sim {
namespace {

/// Quick, and good enough for noise (Marsaglia 2003).
class QuickRandom {
 public:
  explicit QuickRandom(std::uint32_t seed) : state_(2654435769U * (seed + 1)) {}
  /// 0 to 1.
  float share() { return static_cast<float>(bits()) * 0x1p-32F; }
  /// Of deviation 1, at most 3.5: the sum of four bytes.
  float bell() {
    const std::uint32_t b = bits();
    const auto sum = (b & 255U) + (b >> 8 & 255U) + (b >> 16 & 255U) + (b >> 24);
    return (static_cast<float>(sum) - 510.0F) / 147.8F;
  }

 private:
  std::uint32_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    return state_ ^= state_ << 5;
  }

  std::uint32_t state_;
};

}  // namespace

void add_errors(const SensorErrors& errors, std::uint32_t seed, DepthImage& depth_m) {
  if (errors.outline_px > 0) darken_outlines(errors.outline_px, depth_m);
  if (errors.mixed_share > 0) mix_edge_pixels(errors.mixed_share, seed + 1, depth_m);
  if (errors.noise_m_at_1m > 0) add_noise(errors.noise_m_at_1m, seed + 2, depth_m);
  if (errors.step_m_at_1m > 0) quantise(errors.step_m_at_1m, depth_m);
  if (errors.dropout_share > 0) drop_out(errors.dropout_share, seed + 3, depth_m);
}

void add_errors_quickly(const SensorErrors& errors, std::uint32_t seed, DepthImage& depth_m) {
  constexpr auto kNear = static_cast<float>(1 - kEdgeRatio);
  const auto step_m = static_cast<float>(errors.step_m_at_1m);
  const auto noise_m = static_cast<float>(errors.noise_m_at_1m);
  QuickRandom random(seed);
  const DepthImage ideal_m = depth_m;
  for (int v = 1; v < ideal_m.height(); ++v) {
    for (int u = 1; u < ideal_m.width(); ++u) {
      float z = ideal_m(u, v);
      const float near = std::fmin(ideal_m(u - 1, v), ideal_m(u, v - 1));
      if (near < kNear * z && random.share() < errors.mixed_share) {
        z = near + random.share() * (z - near);
      }
      const bool is_lost = random.share() < errors.dropout_share;
      if (step_m > 0) z = 1 / (step_m * std::nearbyint(1 / (step_m * z)));
      depth_m(u, v) = is_lost ? kNoDepth : z + noise_m * z * z * random.bell();
    }
  }
}

float nearest_around_m(const DepthImage& depth_m, int u, int v) {
  float nearest_m = kNoDepth;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, depth_m.height() - 1); ++y) {
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, depth_m.width() - 1); ++x) {
      nearest_m = std::fmin(nearest_m, depth_m(x, y));
    }
  }
  return nearest_m;
}

void quantise(double step_m_at_1m, DepthImage& depth_m) {
  for (float& z : depth_m.pixels()) {
    z = static_cast<float>(1 / (step_m_at_1m * std::round(1 / (step_m_at_1m * z))));
  }
}

void add_noise(double deviation_m_at_1m, std::uint32_t seed, DepthImage& depth_m) {
  Random random(seed);
  for (float& z : depth_m.pixels()) {
    z += static_cast<float>(deviation_m_at_1m * z * z * random.gaussian());
  }
}

void drop_out(double share, std::uint32_t seed, DepthImage& depth_m) {
  Random random(seed);
  for (float& z : depth_m.pixels()) {
    if (random.chance(share)) z = kNoDepth;
  }
}

void mix_edge_pixels(double share, std::uint32_t seed, DepthImage& depth_m) {
  Random random(seed);
  const DepthImage before_m = depth_m;
  at_far_sides(before_m, [&](int u, int v, float near_m) {
    if (!random.chance(share)) return;
    depth_m(u, v) = static_cast<float>(random(near_m, before_m(u, v)));
  });
}

void darken_outlines(int width_px, DepthImage& depth_m) {
  const DepthImage before_m = depth_m;
  const int reach_px = width_px - 1;
  at_far_sides(before_m, [&](int u, int v, float near_m) {
    const double edge_m = (1 - kEdgeRatio / 2) * before_m(u, v);
    for (int y = std::max(v - reach_px, 0); y <= std::min(v + reach_px, depth_m.height() - 1);
         ++y) {
      for (int x = std::max(u - reach_px, 0); x <= std::min(u + reach_px, depth_m.width() - 1);
           ++x) {
        if (before_m(x, y) > std::max<double>(edge_m, near_m)) depth_m(x, y) = kNoDepth;
      }
    }
  });
}

Pose miscalibrated(const Pose& X_BC, double offset_m, double angle_rad, std::uint32_t seed) {
  Random random(seed);
  const Eigen::Vector3d direction = draw_rotation(random) * Eigen::Vector3d::UnitX();
  const Eigen::Vector3d axis = draw_rotation(random) * Eigen::Vector3d::UnitX();
  return X_BC * Eigen::Translation3d(offset_m * direction) *
         Pose(Eigen::AngleAxisd(angle_rad, axis));
}

JointState delayed(const RobotModel& model, const JointState& joints, double delay_s,
                   double speed_per_s, std::uint32_t seed) {
  Random random(seed);
  JointState before = joints;
  before.stamp_s -= delay_s;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const MovableJoint& joint = model.joints[i];
    const double unit = joint.type == JointType::prismatic ? 0.1 : 1;
    const double moved = before.position[i] - unit * speed_per_s * random(-1, 1) * delay_s;
    before.position[i] = std::clamp(moved, joint.lower, joint.upper);
  }
  return before;
}

}  // namespace berth::sim
