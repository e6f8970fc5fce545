#pragma once

#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/image.hpp"
#include "sim/embree_scene.hpp"

namespace berth::sim {

/// A mesh and its pose in a frame W.
struct PosedMesh {
  const TriangleMesh* mesh;
  Pose X_WM;
};

inline constexpr std::uint32_t kNoMesh = 0xFFFFFFFF;

/// What a ray from the camera meets first. mesh = kNoMesh where it meets nothing.
struct SurfaceHit {
  float depth_m = kNoDepth;
  std::uint32_t mesh = kNoMesh;
  std::uint32_t triangle = 0;
  /// Between the ray and the surface's normal, 0 to 1.
  float cosine = 0;
};

/// What an ideal camera sees of meshes that stand still. Constant, may be asked by several threads.
class RayCaster {
 public:
  /// The meshes are copied. Throws std::runtime_error where Embree fails.
  RayCaster(const std::vector<PosedMesh>& meshes, const Pose& X_WC, const Camera& camera,
            EmbreeThreads threads = EmbreeThreads::all);

  const Camera& camera() const { return camera_; }

  /// Of the ray through (u, v), in pixels.
  SurfaceHit hit(double u, double v) const;

  /// Of one ray for each pixel's centre.
  Image<SurfaceHit> cast() const;
  DepthImage cast_depth() const;

  /// Whether a surface stands between the two points.
  bool is_blocked(const Eigen::Vector3f& from_C_m, const Eigen::Vector3f& to_C_m) const;

 private:
  Camera camera_;
  EmbreeDevice device_;
  EmbreeScene scene_;
};

}  // namespace berth::sim
