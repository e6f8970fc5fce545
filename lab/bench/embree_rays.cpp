#include "lab/bench/embree_rays.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "berth/render/link_rect.hpp"
#include "sim/embree.hpp"
#include "sim/embree_scene.hpp"

namespace berth::lab {
namespace {

// A packet of rays is 4 x 4 pixels, a tile 2 x 2 packets.
constexpr int kPacketSide = 4;
constexpr int kPacketRays = kPacketSide * kPacketSide;
constexpr int kTileSide = 8;

sim::EmbreeScene build_scene(RTCDevice device, const TriangleMesh& mesh) {
  sim::EmbreeScene scene(rtcNewScene(device));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  sim::attach_mesh(device, scene.get(), 0, mesh);
  sim::commit_scene(device, scene.get());
  return scene;
}

/// One link; Embree's instID is its place in the list.
struct LinkInstance {
  std::size_t link_index;
  LinkId id;
  Eigen::AlignedBox3f box_L_m;
  sim::EmbreeScene mesh;
};

}  // namespace

/// The scene's frame is the camera's optical frame C and rays are (x, y, 1) t: t is the depth.
struct EmbreeRays::State {
  Camera camera;
  sim::EmbreeDevice device;
  std::vector<LinkInstance> links;
  sim::EmbreeScene scene;
  std::vector<float> ray_x;
  std::vector<float> ray_y;
  /// 1 where a link's rectangle reaches into the tile.
  Image<std::uint8_t> is_in_view;

  explicit State(const Camera& c)
      : camera(c),
        device(sim::make_embree_device()),
        is_in_view((c.width_px + kTileSide - 1) / kTileSide,
                   (c.height_px + kTileSide - 1) / kTileSide) {
    for (int u = 0; u < c.width_px; ++u)
      ray_x.push_back(static_cast<float>((u - c.cx_px) / c.fx_px));
    for (int v = 0; v < c.height_px; ++v)
      ray_y.push_back(static_cast<float>((v - c.cy_px) / c.fy_px));
  }

  void add_links(const RobotModel& model) {
    scene.reset(rtcNewScene(device.get()));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_DYNAMIC);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      const Link& link = model.links[i];
      if (link.role == LinkRole::ignored || link.mesh_L.empty()) continue;
      links.push_back(
          {i, link.id, link.mesh_L.bounding_box_m(), build_scene(device.get(), link.mesh_L)});
      RTCGeometry instance = rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, links.back().mesh.get());
      rtcAttachGeometryByID(scene.get(), instance, static_cast<unsigned>(links.size() - 1));
      rtcReleaseGeometry(instance);
    }
    sim::require_no_embree_error(device.get(), "making the scene of a camera");
  }

  void move_links(const RobotPose& pose, const Pose& X_CB) {
    is_in_view.resize(is_in_view.width(), is_in_view.height(), 0);
    for (std::size_t i = 0; i < links.size(); ++i) {
      const Pose X_CL = X_CB * pose.X_BL[links[i].link_index];
      mark_tiles(project_box(links[i].box_L_m, X_CL, camera));
      const Eigen::Matrix<float, 3, 4> transform = X_CL.matrix().topRows<3>().cast<float>();
      RTCGeometry instance = rtcGetGeometry(scene.get(), static_cast<unsigned>(i));
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, transform.data());
      rtcCommitGeometry(instance);
    }
    rtcCommitScene(scene.get());
  }

  void mark_tiles(const PixelRect& rect) {
    if (rect.empty()) return;
    for (int row = rect.v_begin / kTileSide; row <= (rect.v_end - 1) / kTileSide; ++row) {
      std::uint8_t* first = is_in_view.row(row);
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
    sim::intersect_packet(valid, scene.get(), packet);
    for (int i = 0; i < kPacketRays; ++i) {
      if (valid[i] == 0) continue;
      const int u = u0 + i % kPacketSide;
      const int v = v0 + i / kPacketSide;
      const bool hit = packet.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
      image.depth_m(u, v) = hit ? packet.ray.tfar[i] : kNoDepth;
      image.link_id(u, v) = hit ? links[packet.hit.instID[0][i]].id : kNoLink;
    }
  }

  /// A tile out of view may still hold the robot of the pose before.
  void fill_tile(int column, int row, RobotImage& image) const {
    const int u_begin = column * kTileSide;
    const int v_begin = row * kTileSide;
    if (is_in_view(column, row) == 0) {
      const int u_end = std::min(u_begin + kTileSide, camera.width_px);
      for (int v = v_begin; v < std::min(v_begin + kTileSide, camera.height_px); ++v) {
        std::fill(image.depth_m.row(v) + u_begin, image.depth_m.row(v) + u_end, kNoDepth);
        std::fill(image.link_id.row(v) + u_begin, image.link_id.row(v) + u_end, kNoLink);
      }
      return;
    }
    for (int dv = 0; dv < kTileSide; dv += kPacketSide) {
      for (int du = 0; du < kTileSide; du += kPacketSide) {
        trace_packet(u_begin + du, v_begin + dv, image);
      }
    }
  }
};

EmbreeRays::EmbreeRays(const RobotModel& model, const Camera& camera)
    : state_(std::make_unique<State>(camera)) {
  state_->add_links(model);
}

EmbreeRays::~EmbreeRays() = default;

void EmbreeRays::render(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  State& state = *state_;
  if (image.depth_m.width() != state.camera.width_px ||
      image.depth_m.height() != state.camera.height_px) {
    image.depth_m.resize(state.camera.width_px, state.camera.height_px, kNoDepth);
    image.link_id.resize(state.camera.width_px, state.camera.height_px, kNoLink);
  }
  image.extent = kEverywhere;
  state.move_links(pose, X_BC.inverse());
  tbb::parallel_for(tbb::blocked_range<int>(0, state.is_in_view.height()),
                    [&](const tbb::blocked_range<int>& rows) {
                      for (int row = rows.begin(); row != rows.end(); ++row) {
                        for (int column = 0; column < state.is_in_view.width(); ++column) {
                          state.fill_tile(column, row, image);
                        }
                      }
                    });
}

}  // namespace berth::lab
