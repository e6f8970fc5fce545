#include "sim/ray_caster.hpp"

#include <cmath>
#include <limits>

namespace berth::sim {
namespace {

// A shadow ray starts and ends this far off the surfaces.
constexpr float kOffset_m = 1e-3f;

RTCRay make_ray(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float end) {
  RTCRay ray{};
  ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tfar = end;
  ray.mask = 0xFFFFFFFF;
  return ray;
}

/// Of f(u, v) for each pixel.
template <class T, class F>
Image<T> image_of(const Camera& camera, F f) {
  Image<T> image(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) image(u, v) = f(u, v);
  }
  return image;
}

}  // namespace

RayCaster::RayCaster(const std::vector<PosedMesh>& meshes, const Pose& X_WC, const Camera& camera,
                     EmbreeThreads threads)
    : camera_(camera), device_(make_embree_device(threads)), scene_(rtcNewScene(device_.get())) {
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    attach_mesh(device_.get(), scene_.get(), static_cast<unsigned>(i), *meshes[i].mesh,
                X_WC.inverse() * meshes[i].X_WM);
  }
  commit_scene(device_.get(), scene_.get());
}

SurfaceHit RayCaster::hit(double u, double v) const {
  // The direction's z is 1, so the ray's parameter is the depth.
  const Eigen::Vector3f direction(static_cast<float>((u - camera_.cx_px) / camera_.fx_px),
                                  static_cast<float>((v - camera_.cy_px) / camera_.fy_px), 1);
  RTCRayHit ray{};
  ray.ray = make_ray(Eigen::Vector3f::Zero(), direction, std::numeric_limits<float>::infinity());
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  intersect(scene_.get(), ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
  return {ray.ray.tfar, ray.hit.geomID, ray.hit.primID,
          std::abs(normal.normalized().dot(direction.normalized()))};
}

Image<SurfaceHit> RayCaster::cast() const {
  return image_of<SurfaceHit>(camera_, [&](int u, int v) { return hit(u, v); });
}

DepthImage RayCaster::cast_depth() const {
  return image_of<float>(camera_, [&](int u, int v) { return hit(u, v).depth_m; });
}

bool RayCaster::is_blocked(const Eigen::Vector3f& from_C_m, const Eigen::Vector3f& to_C_m) const {
  const Eigen::Vector3f way = to_C_m - from_C_m;
  const float margin = kOffset_m / way.norm();
  RTCRay ray = make_ray(from_C_m, way, 1 - margin);
  ray.tnear = margin;
  occlude(scene_.get(), ray);
  return ray.tfar < 0;
}

}  // namespace berth::sim
