#include "sim/moving_ray_caster.hpp"

#include <algorithm>
#include <limits>

namespace berth::sim {
namespace {

/// As many rays as Embree takes side by side.
constexpr int kPacket = 16;

/// Rays through pixels of a row, from u on. With 1 along z their length is the depth.
RTCRayHit16 rays_of(const Camera& camera, const Pose& X_BC, int u, int v) {
  RTCRayHit16 rays{};
  const Eigen::Vector3f origin_B = X_BC.translation().cast<float>();
  for (int i = 0; i < kPacket; ++i) {
    const Eigen::Vector3d direction_C((u + i - camera.cx_px) / camera.fx_px,
                                      (v - camera.cy_px) / camera.fy_px, 1);
    const Eigen::Vector3f direction_B = (X_BC.linear() * direction_C).cast<float>();
    rays.ray.org_x[i] = origin_B.x();
    rays.ray.org_y[i] = origin_B.y();
    rays.ray.org_z[i] = origin_B.z();
    rays.ray.dir_x[i] = direction_B.x();
    rays.ray.dir_y[i] = direction_B.y();
    rays.ray.dir_z[i] = direction_B.z();
    rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
    rays.ray.mask[i] = ~0U;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  return rays;
}

void cast_row(RTCScene scene, const Camera& camera, const Pose& X_BC, int v, float* row_m) {
  for (int u = 0; u < camera.width_px; u += kPacket) {
    const int count = std::min(kPacket, camera.width_px - u);
    alignas(64) int valid[kPacket];
    for (int i = 0; i < kPacket; ++i) valid[i] = i < count ? -1 : 0;
    alignas(64) RTCRayHit16 rays = rays_of(camera, X_BC, u, v);
    intersect_packet(valid, scene, rays);
    for (int i = 0; i < count; ++i) {
      const bool is_hit = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      row_m[u + i] = is_hit ? rays.ray.tfar[i] : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace

MovingRayCaster::MovingRayCaster(const std::vector<TriangleMesh>& meshes)
    : device_(make_embree_device()), scene_(rtcNewScene(device_.get())) {
  RTCDevice device = device_.get();
  for (const TriangleMesh& mesh : meshes) {
    const EmbreeScene& own = meshes_.emplace_back(rtcNewScene(device));
    attach_mesh(device, own.get(), 0, mesh);
    commit_scene(device, own.get());
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, own.get());
    rtcAttachGeometry(scene_.get(), instance);
    rtcReleaseGeometry(instance);
    instances_.push_back(instance);
  }
  require_no_embree_error(device, "placing meshes");
}

DepthImage MovingRayCaster::cast(const Camera& camera, const Pose& X_BC,
                                 const std::vector<Pose>& X_BM) {
  for (std::size_t i = 0; i < X_BM.size(); ++i) {
    const Eigen::Matrix4f X = X_BM[i].matrix().cast<float>();
    rtcSetGeometryTransform(instances_[i], 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, X.data());
    rtcCommitGeometry(instances_[i]);
  }
  commit_scene(device_.get(), scene_.get());
  DepthImage depth_m(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    cast_row(scene_.get(), camera, X_BC, v, &depth_m(0, v));
  }
  return depth_m;
}

}  // namespace berth::sim
