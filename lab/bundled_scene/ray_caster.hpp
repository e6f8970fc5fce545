#pragma once

#include <memory>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "lab/bundled_scene/mesh.hpp"

namespace berth::lab {

/// A mesh and its pose in the table's frame.
struct PosedMesh {
  const DrawnMesh* mesh;
  Pose X_TM;
};

inline constexpr std::uint32_t kNothing = 0xFFFFFFFF;

/// What the ray through a pixel's centre meets first. mesh = kNothing where it meets nothing.
struct SensorHit {
  float depth_m;
  std::uint32_t mesh;
  std::uint32_t triangle;
  float cosine;  ///< between the ray and the surface's normal, 0 to 1
};

/// A still scene in the camera's optical frame C.
class RayCaster {
 public:
  /// X_TC is the camera's pose in the table's frame.
  RayCaster(const std::vector<PosedMesh>& meshes, const Pose& X_TC);

  /// One ray for each pixel's centre.
  Image<SensorHit> cast(const Camera& camera) const;

  /// Whether a surface stands between the two points.
  bool is_blocked(const Eigen::Vector3f& from_C_m, const Eigen::Vector3f& to_C_m) const;

 private:
  struct Deleter {
    void operator()(void* scene) const;
  };
  std::unique_ptr<void, Deleter> scene_;
};

}  // namespace berth::lab
