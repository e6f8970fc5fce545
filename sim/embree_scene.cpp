#include "sim/embree_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace berth::sim {

EmbreeDevice make_embree_device(EmbreeThreads threads) {
  EmbreeDevice device(rtcNewDevice(threads == EmbreeThreads::one ? "threads=1" : nullptr));
  if (!device) require_no_embree_error(nullptr, "making a device");
  return device;
}

void require_no_embree_error(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree: {}: error {}", doing, static_cast<int>(error)));
}

void attach_mesh(RTCDevice device, RTCScene scene, unsigned number, const TriangleMesh& mesh,
                 const Pose& X) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices_m.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  require_no_embree_error(device, "allocating a mesh");
  for (const auto& vertex : mesh.vertices_m) {
    const Eigen::Vector3f p = (X * vertex.cast<double>()).cast<float>();
    vertices = std::copy(p.data(), p.data() + 3, vertices);
  }
  for (const auto& triangle : mesh.triangles)
    indices = std::copy(triangle.begin(), triangle.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, number);
  rtcReleaseGeometry(geometry);
}

void commit_scene(RTCDevice device, RTCScene scene) {
  rtcCommitScene(scene);
  require_no_embree_error(device, "building a scene");
}

}  // namespace berth::sim
