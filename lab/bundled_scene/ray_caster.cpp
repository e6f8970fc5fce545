#include "lab/bundled_scene/ray_caster.hpp"

#include <embree3/rtcore.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace berth::lab {
namespace {

// A shadow ray starts and ends this far off the surfaces.
constexpr float kOffset_m = 1e-3f;

void attach(RTCDevice device, RTCScene scene, const PosedMesh& posed, const Pose& X_CT) {
  const DrawnMesh& mesh = *posed.mesh;
  const Pose X_CM = X_CT * posed.X_TM;
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                             RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                             mesh.vertex_m.size()));
  auto* index = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangle.size()));
  for (const Eigen::Vector3f& p_M : mesh.vertex_m) {
    Eigen::Map<Eigen::Vector3f> p_C(vertex);
    p_C = (X_CM * p_M.cast<double>()).cast<float>();
    vertex += 3;
  }
  for (const auto& triangle : mesh.triangle)
    for (const std::uint32_t corner : triangle) *index++ = corner;
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

RTCRay make_ray(const Eigen::Vector3f& from, const Eigen::Vector3f& direction, float end) {
  RTCRay ray{};
  ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tfar = end;
  ray.mask = 0xFFFFFFFF;
  return ray;
}

}  // namespace

void RayCaster::Deleter::operator()(void* scene) const {
  rtcReleaseScene(static_cast<RTCScene>(scene));
}

RayCaster::RayCaster(const std::vector<PosedMesh>& meshes, const Pose& X_TC) {
  // One thread: the tree, and with it which of two touching triangles a ray meets, is always the
  // same.
  const RTCDevice device = rtcNewDevice("threads=1");
  if (device == nullptr) throw std::runtime_error("Embree: no device, expected one");
  const RTCScene scene = rtcNewScene(device);
  rtcReleaseDevice(device);
  scene_.reset(scene);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  for (const PosedMesh& posed : meshes) attach(device, scene, posed, X_TC.inverse());
  rtcCommitScene(scene);
}

Image<SensorHit> RayCaster::cast(const Camera& camera) const {
  Image<SensorHit> hits(camera.width_px, camera.height_px, {kNoDepth, kNothing, kNothing, 0});
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      // The direction's z is 1, so the ray's parameter is the depth.
      const Eigen::Vector3f direction(static_cast<float>((u - camera.cx_px) / camera.fx_px),
                                      static_cast<float>((v - camera.cy_px) / camera.fy_px), 1);
      RTCRayHit ray{};
      ray.ray =
          make_ray(Eigen::Vector3f::Zero(), direction, std::numeric_limits<float>::infinity());
      ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      rtcIntersect1(static_cast<RTCScene>(scene_.get()), &context, &ray);
      if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
      const Eigen::Vector3f normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
      hits(u, v) = {ray.ray.tfar, ray.hit.geomID, ray.hit.primID,
                    std::abs(normal.normalized().dot(direction.normalized()))};
    }
  }
  return hits;
}

bool RayCaster::is_blocked(const Eigen::Vector3f& from_C_m, const Eigen::Vector3f& to_C_m) const {
  const Eigen::Vector3f way = to_C_m - from_C_m;
  const float margin = kOffset_m / way.norm();
  RTCRay ray = make_ray(from_C_m, way, 1 - margin);
  ray.tnear = margin;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(static_cast<RTCScene>(scene_.get()), &context, &ray);
  return ray.tfar < 0;
}

}  // namespace berth::lab
