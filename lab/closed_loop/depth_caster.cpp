#include "lab/closed_loop/depth_caster.hpp"

#include <algorithm>
#include <limits>

#include "tests/support/embree_handles.hpp"

namespace berth::lab {
namespace {

EmbreeScene scene_of(RTCDevice device, const TriangleMesh& mesh) {
  EmbreeScene scene(rtcNewScene(device));
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices_m.size()));
  for (const auto& vertex : mesh.vertices_m) vertices = std::copy_n(vertex.data(), 3, vertices);
  auto* indices = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(unsigned), mesh.triangles.size()));
  for (const auto& triangle : mesh.triangles) indices = std::copy_n(triangle.data(), 3, indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  return scene;
}

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
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene, &context, &rays);
    for (int i = 0; i < count; ++i) {
      const bool is_hit = rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      row_m[u + i] = is_hit ? rays.ray.tfar[i] : std::numeric_limits<float>::quiet_NaN();
    }
  }
}

}  // namespace

struct DepthCaster::State {
  EmbreeDevice device;
  std::vector<EmbreeScene> meshes;
  EmbreeScene scene;
  /// Owned by `scene`.
  std::vector<RTCGeometry> instances;
};

DepthCaster::DepthCaster(const std::vector<TriangleMesh>& meshes)
    : state_(std::make_unique<State>()) {
  state_->device.reset(rtcNewDevice("threads=1"));
  if (!state_->device) require_no_embree_error(nullptr, "making a device");
  RTCDevice device = state_->device.get();
  state_->scene.reset(rtcNewScene(device));
  for (const TriangleMesh& mesh : meshes) {
    state_->meshes.push_back(scene_of(device, mesh));
    RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, state_->meshes.back().get());
    rtcAttachGeometry(state_->scene.get(), instance);
    rtcReleaseGeometry(instance);
    state_->instances.push_back(instance);
  }
  require_no_embree_error(device, "building meshes");
}

DepthCaster::~DepthCaster() = default;

DepthImage DepthCaster::cast(const Camera& camera, const Pose& X_BC,
                             const std::vector<Pose>& X_BM) {
  for (std::size_t i = 0; i < X_BM.size(); ++i) {
    const Eigen::Matrix4f X = X_BM[i].matrix().cast<float>();
    rtcSetGeometryTransform(state_->instances[i], 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, X.data());
    rtcCommitGeometry(state_->instances[i]);
  }
  rtcCommitScene(state_->scene.get());
  require_no_embree_error(state_->device.get(), "placing meshes");
  DepthImage depth_m(camera.width_px, camera.height_px);
  for (int v = 0; v < camera.height_px; ++v) {
    cast_row(state_->scene.get(), camera, X_BC, v, &depth_m(0, v));
  }
  return depth_m;
}

}  // namespace berth::lab
