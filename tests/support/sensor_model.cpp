#include "tests/support/sensor_model.hpp"

#include <algorithm>
#include <cmath>

#include "tests/support/drawn_obstacles.hpp"
#include "tests/support/random.hpp"

namespace berth::testing {
namespace {

/// The nearest reading of the eight neighbours, NaN where there is none.
float nearest_neighbour_m(const DepthImage& depth_m, int u, int v) {
  float nearest_m = kNoDepth;
  for (int y = std::max(v - 1, 0); y <= std::min(v + 1, depth_m.height() - 1); ++y) {
    for (int x = std::max(u - 1, 0); x <= std::min(u + 1, depth_m.width() - 1); ++x) {
      nearest_m = std::fmin(nearest_m, depth_m(x, y));
    }
  }
  return nearest_m;
}

/// Calls action(u, v, near_m) at the far side of each depth edge of `depth_m`.
template <class Action>
void at_far_sides(const DepthImage& depth_m, Action action) {
  for (int v = 0; v < depth_m.height(); ++v) {
    for (int u = 0; u < depth_m.width(); ++u) {
      const float near_m = nearest_neighbour_m(depth_m, u, v);
      if (near_m < (1 - kEdgeRatio) * depth_m(u, v)) action(u, v, near_m);
    }
  }
}

}  // namespace

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

}  // namespace berth::testing
