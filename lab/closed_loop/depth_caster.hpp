#pragma once

#include <memory>
#include <vector>

#include "berth/robot/triangle_mesh.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"

namespace berth::lab {

/// What an ideal depth camera sees of rigid meshes that move: Embree's rays, one for each pixel's
/// centre.
class DepthCaster {
 public:
  /// Throws std::runtime_error where Embree fails.
  explicit DepthCaster(const std::vector<TriangleMesh>& meshes);
  ~DepthCaster();
  DepthCaster(const DepthCaster&) = delete;
  DepthCaster& operator=(const DepthCaster&) = delete;

  /// X_BM[i] is the pose of meshes[i]. NaN where nothing is.
  DepthImage cast(const Camera& camera, const Pose& X_BC, const std::vector<Pose>& X_BM);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace berth::lab
