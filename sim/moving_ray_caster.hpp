#pragma once

#include <vector>

#include "berth/types/image.hpp"
#include "sim/embree_scene.hpp"

namespace berth::sim {

/// What an ideal depth camera sees of rigid meshes that move: the trees of meshes are built once,
/// where RayCaster builds them for each pose.
class MovingRayCaster {
 public:
  /// The meshes are copied. Throws std::runtime_error where Embree fails.
  explicit MovingRayCaster(const std::vector<TriangleMesh>& meshes);

  /// One ray for each pixel's centre; X_BM[i] is the pose of meshes[i]. NaN where nothing is.
  DepthImage cast(const Camera& camera, const Pose& X_BC, const std::vector<Pose>& X_BM);
  /// The same, before what the image shows already, such as all that stands still. Rays that meet
  /// none of the boxes around the meshes are not cast.
  void cast_before(const Camera& camera, const Pose& X_BC, const std::vector<Pose>& X_BM,
                   DepthImage& depth_m);

 private:
  void move(const std::vector<Pose>& X_BM);

  EmbreeDevice device_;
  std::vector<EmbreeScene> meshes_;
  std::vector<Eigen::AlignedBox3f> boxes_M_m_;
  EmbreeScene scene_;
  /// Owned by `scene_`.
  std::vector<RTCGeometry> instances_;
};

}  // namespace berth::sim
