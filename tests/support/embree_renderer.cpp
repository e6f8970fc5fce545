#include "tests/support/embree_renderer.hpp"
#include "tests/support/embree_handles.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace berth {
namespace {

/// The mesh in the camera's frame.
void add_mesh(RTCDevice device, RTCScene scene, unsigned index, const TriangleMesh& mesh_L,
              const Pose& X_CL) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh_L.vertices_m.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh_L.triangles.size()));
  require_no_embree_error(device, "allocating a mesh");
  for (const auto& p_L : mesh_L.vertices_m) {
    const Eigen::Vector3f p_C = (X_CL * p_L.cast<double>()).cast<float>();
    vertices = std::copy(p_C.data(), p_C.data() + 3, vertices);
  }
  for (const auto& triangle : mesh_L.triangles)
    indices = std::copy(triangle.begin(), triangle.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, index);
  rtcReleaseGeometry(geometry);
}

}  // namespace

struct EmbreeRenderer::State {
  Camera camera;
  EmbreeDevice device;
  EmbreeScene scene;
  /// By the index of a link, which is Embree's geomID.
  std::vector<LinkId> ids;
};

EmbreeRenderer::EmbreeRenderer(const RobotModel& model, const RobotPose& pose, const Pose& X_BC,
                               const Camera& camera)
    : state_(std::make_unique<State>()) {
  state_->camera = camera;
  state_->device.reset(rtcNewDevice(nullptr));
  if (!state_->device) require_no_embree_error(nullptr, "making a device");
  state_->scene.reset(rtcNewScene(state_->device.get()));
  rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    const Link& link = model.links[i];
    state_->ids.push_back(link.id);
    if (link.role == LinkRole::ignored || link.mesh_L.empty()) continue;
    add_mesh(state_->device.get(), state_->scene.get(), static_cast<unsigned>(i), link.mesh_L,
             X_BC.inverse() * pose.X_BL[i]);
  }
  rtcCommitScene(state_->scene.get());
  require_no_embree_error(state_->device.get(), "building a scene");
}

EmbreeRenderer::~EmbreeRenderer() = default;

RayHit EmbreeRenderer::hit(double u, double v) const {
  const Camera& camera = state_->camera;
  RTCRayHit query{};
  // Not a unit vector: with 1 along z, the distance along the ray is the depth.
  query.ray.dir_x = static_cast<float>((u - camera.cx_px) / camera.fx_px);
  query.ray.dir_y = static_cast<float>((v - camera.cy_px) / camera.fy_px);
  query.ray.dir_z = 1;
  query.ray.tfar = std::numeric_limits<float>::infinity();
  query.ray.mask = ~0U;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(state_->scene.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {state_->ids[query.hit.geomID], query.ray.tfar, query.hit.primID};
}

}  // namespace berth
