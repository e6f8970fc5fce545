#include "sim/moving_ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace berth::sim {
namespace {

/// As many rays as Embree takes side by side.
constexpr int kPacket = 16;

/// Rays through `count` pixels of a row, from u on, to what it shows there; `valid` is -1 for each.
/// With 1 along z their length is the depth.
RTCRayHit16 rays_of(const Camera& camera, const Pose& X_BC, int u, int v, const float* row_m,
                    int count, int* valid) {
  RTCRayHit16 rays{};
  const Eigen::Vector3f origin_B = X_BC.translation().cast<float>();
  for (int i = 0; i < kPacket; ++i) {
    const Eigen::Vector3d direction_C((u + i - camera.cx_px) / camera.fx_px,
                                      (v - camera.cy_px) / camera.fy_px, 1);
    const Eigen::Vector3f direction_B = (X_BC.linear() * direction_C).cast<float>();
    valid[i] = i < count ? -1 : 0;
    const bool is_open = i >= count || std::isnan(row_m[u + i]);
    rays.ray.org_x[i] = origin_B.x();
    rays.ray.org_y[i] = origin_B.y();
    rays.ray.org_z[i] = origin_B.z();
    rays.ray.dir_x[i] = direction_B.x();
    rays.ray.dir_y[i] = direction_B.y();
    rays.ray.dir_z[i] = direction_B.z();
    rays.ray.tfar[i] = is_open ? std::numeric_limits<float>::infinity() : row_m[u + i];
    rays.ray.mask[i] = ~0U;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
  }
  return rays;
}

void cast_packet(RTCScene scene, const Camera& camera, const Pose& X_BC, int u, int v,
                 float* row_m) {
  const int count = std::min(kPacket, camera.width_px - u);
  alignas(64) int valid[kPacket];
  alignas(64) RTCRayHit16 rays = rays_of(camera, X_BC, u, v, row_m, count, valid);
  intersect_packet(valid, scene, rays);
  for (int i = 0; i < count; ++i) {
    if (rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID) row_m[u + i] = rays.ray.tfar[i];
  }
}

/// The pixels that a box may be seen in: all of them where it reaches behind the camera.
PixelRect pixels_of(const Camera& camera, const Pose& X_CM, const Eigen::AlignedBox3f& box_M_m) {
  constexpr double kLeastDepth_m = 0.01;
  const PixelRect all{0, 0, camera.width_px, camera.height_px};
  Eigen::AlignedBox2d seen;
  for (int i = 0; i < 8; ++i) {
    const auto corner = static_cast<Eigen::AlignedBox3f::CornerType>(i);
    const Eigen::Vector3d p_C_m = X_CM * box_M_m.corner(corner).cast<double>();
    if (p_C_m.z() < kLeastDepth_m) return all;
    seen.extend(Eigen::Vector2d(camera.fx_px * p_C_m.x() / p_C_m.z() + camera.cx_px,
                                camera.fy_px * p_C_m.y() / p_C_m.z() + camera.cy_px));
  }
  // One pixel more is more than what rounds.
  const auto pixel = [](double at, int most) {
    return static_cast<int>(std::clamp(std::floor(at), -1.0, most + 1.0));
  };
  return clip(
      {pixel(seen.min().x(), camera.width_px), pixel(seen.min().y(), camera.height_px),
       pixel(seen.max().x(), camera.width_px) + 2, pixel(seen.max().y(), camera.height_px) + 2},
      camera.width_px, camera.height_px);
}

}  // namespace

MovingRayCaster::MovingRayCaster(const std::vector<TriangleMesh>& meshes)
    : device_(make_embree_device()), scene_(rtcNewScene(device_.get())) {
  RTCDevice device = device_.get();
  for (const TriangleMesh& mesh : meshes) {
    boxes_M_m_.push_back(mesh.bounding_box_m());
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

void MovingRayCaster::move(const std::vector<Pose>& X_BM) {
  for (std::size_t i = 0; i < X_BM.size(); ++i) {
    const Eigen::Matrix4f X = X_BM[i].matrix().cast<float>();
    rtcSetGeometryTransform(instances_[i], 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, X.data());
    rtcCommitGeometry(instances_[i]);
  }
  commit_scene(device_.get(), scene_.get());
}

DepthImage MovingRayCaster::cast(const Camera& camera, const Pose& X_BC,
                                 const std::vector<Pose>& X_BM) {
  DepthImage depth_m(camera.width_px, camera.height_px, kNoDepth);
  cast_before(camera, X_BC, X_BM, depth_m);
  return depth_m;
}

void MovingRayCaster::cast_before(const Camera& camera, const Pose& X_BC,
                                  const std::vector<Pose>& X_BM, DepthImage& depth_m) {
  move(X_BM);
  Image<std::uint8_t> is_wanted((camera.width_px + kPacket - 1) / kPacket, camera.height_px, 0);
  for (std::size_t i = 0; i < X_BM.size(); ++i) {
    const PixelRect rect = pixels_of(camera, X_BC.inverse() * X_BM[i], boxes_M_m_[i]);
    if (rect.empty()) continue;
    for (int v = rect.v_begin; v < rect.v_end; ++v) {
      for (int k = rect.u_begin / kPacket; k <= (rect.u_end - 1) / kPacket; ++k) {
        is_wanted(k, v) = 1;
      }
    }
  }
  for (int v = 0; v < camera.height_px; ++v) {
    for (int k = 0; k < is_wanted.width(); ++k) {
      if (is_wanted(k, v) == 0) continue;
      cast_packet(scene_.get(), camera, X_BC, kPacket * k, v, &depth_m(0, v));
    }
  }
}

}  // namespace berth::sim
