// Views made by hand: a camera at its frame's origin, and what it sees as a function of the pixel.
#pragma once

#include "sim/whole_robot_points.hpp"

namespace berth::sim {

/// 41 x 31 pixels, the middle one on the axis, 40 px of focal length.
inline constexpr Camera kFlatCamera{41, 31, 40, 40, 20, 15};

/// S(u, v) = F(u, v) = depth_of(u, v): all obstacles; NaN is no reading.
template <class DepthOf>
PointView flat_view(DepthOf depth_of, const Pose& X_BC = Pose::Identity()) {
  PointView view;
  view.camera = kFlatCamera;
  view.X_BC = X_BC;
  view.sensor_depth_m = DepthImage(kFlatCamera.width_px, kFlatCamera.height_px);
  view.fate = Image<PixelFate>(kFlatCamera.width_px, kFlatCamera.height_px, PixelFate::obstacle);
  for (int v = 0; v < kFlatCamera.height_px; ++v) {
    for (int u = 0; u < kFlatCamera.width_px; ++u) {
      view.sensor_depth_m(u, v) = static_cast<float>(depth_of(u, v));
      if (std::isnan(view.sensor_depth_m(u, v))) view.fate(u, v) = PixelFate::no_reading;
    }
  }
  view.obstacle_depth_m = view.sensor_depth_m;
  return view;
}

inline PointView wall_at(double depth_m, const Pose& X_BC = Pose::Identity()) {
  return flat_view([&](int, int) { return depth_m; }, X_BC);
}

/// The filter drops the pixel.
inline void drop(PointView& view, int u, int v, PixelFate fate) {
  view.fate(u, v) = fate;
  view.obstacle_depth_m(u, v) = kNoDepth;
}

/// A camera on the left, at x = -away_m and z = 1, that looks along x.
inline Pose from_the_left(double away_m) {
  Pose X_BC = Pose::Identity();
  X_BC.linear() << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  X_BC.translation() = Eigen::Vector3d(-away_m, 0, 1);
  return X_BC;
}

}  // namespace berth::sim
