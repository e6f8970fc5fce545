#include "berth/render/robot_renderer.hpp"

#include <embree3/rtcore.h>
#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "berth/render/link_rect.hpp"

namespace berth {
namespace {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using Scene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

// A packet of rays is 4 x 4 pixels, a tile 2 x 2 packets.
constexpr int kPacketSide = 4;
constexpr int kPacketRays = kPacketSide * kPacketSide;
constexpr int kTileSide = 8;

void require_no_error(RTCDevice device, const char* doing) {
  const RTCError error = rtcGetDeviceError(device);
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error(fmt::format("Embree: {}: error {}", doing, static_cast<int>(error)));
}

Scene build_scene(RTCDevice device, const TriangleMesh& mesh) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices_m.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  require_no_error(device, "allocating a mesh");
  for (const auto& p : mesh.vertices_m) vertices = std::copy(p.data(), p.data() + 3, vertices);
  for (const auto& triangle : mesh.triangles)
    indices = std::copy(triangle.begin(), triangle.end(), indices);
  rtcCommitGeometry(geometry);
  Scene scene(rtcNewScene(device));
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  require_no_error(device, "building a mesh");
  return scene;
}

}  // namespace

class LinkMeshes {
 public:
  struct LinkMesh {
    std::size_t link_index;
    LinkId id;
    Eigen::AlignedBox3f box_L;
    Scene scene;
  };

  explicit LinkMeshes(const RobotModel& model) : device_(rtcNewDevice(nullptr)) {
    if (!device_) require_no_error(nullptr, "making a device");
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const Link& link = model.links[i];
      if (link.role == LinkRole::ignored) continue;
      meshes_.push_back(
          {i, link.id, link.mesh_L.bounding_box_m(), build_scene(device_.get(), link.mesh_L)});
    }
  }

  RTCDevice device() const { return device_.get(); }
  const std::vector<LinkMesh>& meshes() const { return meshes_; }

 private:
  Device device_;
  std::vector<LinkMesh> meshes_;
};

std::shared_ptr<const LinkMeshes> build_link_meshes(const RobotModel& model) {
  return std::make_shared<const LinkMeshes>(model);
}

/// The scene's frame is the camera's optical frame C and rays are (x, y, 1) t: t is the depth.
struct RobotRenderer::State {
  std::shared_ptr<const LinkMeshes> links;
  Camera camera;
  Scene scene;
  std::vector<float> ray_x;
  std::vector<float> ray_y;
  int tile_columns;
  int tile_rows;
  std::vector<std::uint8_t> tile_in_view;

  State(std::shared_ptr<const LinkMeshes> link_meshes, const Camera& c)
      : links(std::move(link_meshes)),
        camera(c),
        scene(rtcNewScene(links->device())),
        tile_columns((c.width_px + kTileSide - 1) / kTileSide),
        tile_rows((c.height_px + kTileSide - 1) / kTileSide),
        tile_in_view(static_cast<std::size_t>(tile_columns) * tile_rows) {
    for (int u = 0; u < c.width_px; ++u)
      ray_x.push_back(static_cast<float>((u - c.cx_px) / c.fx_px));
    for (int v = 0; v < c.height_px; ++v)
      ray_y.push_back(static_cast<float>((v - c.cy_px) / c.fy_px));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    for (std::size_t i = 0; i < links->meshes().size(); ++i) {
      RTCGeometry instance = rtcNewGeometry(links->device(), RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, links->meshes()[i].scene.get());
      rtcAttachGeometryByID(scene.get(), instance, static_cast<unsigned>(i));
      rtcReleaseGeometry(instance);
    }
    require_no_error(links->device(), "making the scene of a camera");
  }

  /// Returns where the robot may be seen.
  PixelRect commit(const RobotPose& pose, const Pose& X_CB) {
    PixelRect extent;
    std::fill(tile_in_view.begin(), tile_in_view.end(), std::uint8_t{0});
    for (std::size_t i = 0; i < links->meshes().size(); ++i) {
      const auto& mesh = links->meshes()[i];
      const Pose X_CL = X_CB * pose.X_BL[mesh.link_index];
      const PixelRect rect = project_box(mesh.box_L, X_CL, camera);
      extent = united(extent, rect);
      mark_tiles(rect);
      const Eigen::Matrix<float, 3, 4> transform = X_CL.matrix().topRows<3>().cast<float>();
      RTCGeometry instance = rtcGetGeometry(scene.get(), static_cast<unsigned>(i));
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
      rtcCommitGeometry(instance);
    }
    rtcCommitScene(scene.get());
    return extent;
  }

  void mark_tiles(const PixelRect& rect) {
    if (rect.empty()) return;
    for (int row = rect.v_begin / kTileSide; row <= (rect.v_end - 1) / kTileSide; ++row) {
      const auto first = tile_in_view.begin() + row * tile_columns;
      std::fill(first + rect.u_begin / kTileSide, first + (rect.u_end - 1) / kTileSide + 1,
                std::uint8_t{1});
    }
  }

  void trace_packet(int u0, int v0, RobotImage& image) const {
    alignas(64) int valid[kPacketRays];
    alignas(64) RTCRayHit16 packet;
    for (int i = 0; i < kPacketRays; ++i) {
      const int u = u0 + i % kPacketSide;
      const int v = v0 + i / kPacketSide;
      const bool inside = u < camera.width_px && v < camera.height_px;
      valid[i] = inside ? -1 : 0;
      packet.ray.org_x[i] = packet.ray.org_y[i] = packet.ray.org_z[i] = 0;
      packet.ray.dir_x[i] = inside ? ray_x[u] : 0;
      packet.ray.dir_y[i] = inside ? ray_y[v] : 0;
      packet.ray.dir_z[i] = 1;
      packet.ray.tnear[i] = packet.ray.time[i] = 0;
      packet.ray.tfar[i] = std::numeric_limits<float>::infinity();
      packet.ray.mask[i] = ~0U;
      packet.ray.id[i] = packet.ray.flags[i] = 0;
      packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene.get(), &context, &packet);
    for (int i = 0; i < kPacketRays; ++i) {
      if (valid[i] == 0 || packet.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
      const int u = u0 + i % kPacketSide;
      const int v = v0 + i / kPacketSide;
      image.depth_m(u, v) = packet.ray.tfar[i];
      image.link_id(u, v) = links->meshes()[packet.hit.instID[0][i]].id;
    }
  }

  void trace_tile_row(int row, RobotImage& image) const {
    for (int column = 0; column < tile_columns; ++column) {
      if (tile_in_view[static_cast<std::size_t>(row) * tile_columns + column] == 0) continue;
      for (int dv = 0; dv < kTileSide; dv += kPacketSide) {
        for (int du = 0; du < kTileSide; du += kPacketSide) {
          trace_packet(column * kTileSide + du, row * kTileSide + dv, image);
        }
      }
    }
  }
};

RobotRenderer::RobotRenderer(std::shared_ptr<const LinkMeshes> meshes, const Camera& camera) {
  const bool focal_ok = camera.fx_px > 0 && camera.fy_px > 0 && std::isfinite(camera.fx_px) &&
                        std::isfinite(camera.fy_px);
  if (camera.width_px <= 0 || camera.height_px <= 0 || !focal_ok || !std::isfinite(camera.cx_px) ||
      !std::isfinite(camera.cy_px)) {
    throw std::invalid_argument(fmt::format(
        "camera: {} x {} px, fx {}, fy {}, cx {}, cy {}; expected a positive size and "
        "positive focal lengths, all finite",
        camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px));
  }
  state_ = std::make_unique<State>(std::move(meshes), camera);
}
RobotRenderer::~RobotRenderer() = default;
RobotRenderer::RobotRenderer(RobotRenderer&&) noexcept = default;
RobotRenderer& RobotRenderer::operator=(RobotRenderer&&) noexcept = default;

void RobotRenderer::render(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  State& state = *state_;
  assert(state.links->meshes().empty() ||
         state.links->meshes().back().link_index < pose.X_BL.size());
  if (!X_BC.matrix().allFinite()) {
    throw std::invalid_argument(
        fmt::format("pose of the camera at {} {} {}: expected finite numbers",
                    X_BC.translation().x(), X_BC.translation().y(), X_BC.translation().z()));
  }
  image.depth_m.resize(state.camera.width_px, state.camera.height_px, kNoDepth);
  image.link_id.resize(state.camera.width_px, state.camera.height_px, kNoLink);
  image.extent = state.commit(pose, X_BC.inverse());
  tbb::parallel_for(tbb::blocked_range<int>(0, state.tile_rows),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row != rows.end(); ++row)
                        state.trace_tile_row(row, image);
                    });
}

}  // namespace berth
