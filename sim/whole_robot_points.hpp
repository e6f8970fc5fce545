// Whether one point is an obstacle once several cameras have looked: the
// definition of the whole robot's distances as it is written down, without anything that makes it
// fast.
#pragma once

#include <vector>

#include "berth/space/settings.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth::sim {

/// What one camera brought.
struct PointView {
  Camera camera;
  /// The optical frame C in the robot's root frame B.
  Pose X_BC = Pose::Identity();
  /// S: the sensor's raw depth.
  DepthImage sensor_depth_m;
  /// F, and what became of each pixel of S.
  DepthImage obstacle_depth_m;
  Image<PixelFate> fate;
  /// Where environment begins and ends along each pixel's ray; of no size where that is not known.
  DepthImage environment_front_m = {};
  DepthImage environment_back_m = {};
  /// By how much it is older than the newest one.
  double age_s = 0;
};

/// An older view shows nothing (D6).
inline constexpr double kYoung_s = 0.2;

/// Free depth E: a point that projects into the pixel is seen free where its depth is above 0 and
/// below this (D1, D2, D6). Infinite where nothing stands.
Image<double> free_depth_m(const PointView& view, const SpaceSettings& settings);

/// All views together.
class PointSpace {
 public:
  PointSpace(std::vector<PointView> views, const SpaceSettings& settings);

  const std::vector<PointView>& views() const { return views_; }
  const SpaceSettings& settings() const { return settings_; }
  /// E of view k.
  const Image<double>& free_depth(std::size_t k) const { return free_depth_m_[k]; }

  /// H of view k, and the depth up to which a pixel of it hides.
  const DepthImage& hidden_from_m(std::size_t k) const { return hidden_from_m_[k]; }
  double hidden_to_m(std::size_t k, Pixel pixel) const;

  /// In the surface layer of some pixel of view k.
  bool is_reading(std::size_t k, const Eigen::Vector3d& p_B) const;
  bool is_behind(std::size_t k, const Eigen::Vector3d& p_B) const;
  bool is_free(std::size_t k, const Eigen::Vector3d& p_B) const;

  /// In a surface layer (D4).
  bool is_reading(const Eigen::Vector3d& p_B) const;
  /// Whether view k is young enough to tell anything of what lies in its image.
  bool is_young(std::size_t k) const { return views_[k].age_s <= kYoung_s; }
  /// In the image of no young view, where that counts as unknown.
  bool is_unobserved(const Eigen::Vector3d& p_B) const;

  /// Behind a surface layer of some view, and seen free by no other, or unobserved (D5).
  bool is_hidden(const Eigen::Vector3d& p_B) const;
  bool is_obstacle(const Eigen::Vector3d& p_B) const { return is_reading(p_B) || is_hidden(p_B); }

 private:
  std::vector<PointView> views_;
  SpaceSettings settings_;
  std::vector<Image<double>> free_depth_m_;
  std::vector<DepthImage> hidden_from_m_;
};

/// The pixel that p_C projects into; (-1, -1) outside of the image and behind the camera.
Pixel plain_pixel_of(const Camera& camera, const Eigen::Vector3d& p_C);

}  // namespace berth::sim
