#include "tests/support/nearest_on_mesh.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "tests/support/embree_handles.hpp"

namespace berth::testing {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  if (length2 == 0) return a;
  return a + std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) * (b - a);
}

/// Whether p lies over the triangle's inside, along its normal.
bool is_over(const Eigen::Vector3d& p, const Triangle& t, const Eigen::Vector3d& normal) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = t[i];
    const Eigen::Vector3d& b = t[(i + 1) % 3];
    if ((b - a).cross(p - a).dot(normal) < 0) return false;
  }
  return true;
}

Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Triangle& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  if (normal.squaredNorm() > 0 && is_over(p, t, normal)) {
    return p - normal * (normal.dot(p - t[0]) / normal.squaredNorm());
  }
  Eigen::Vector3d nearest = nearest_on_segment(p, t[0], t[1]);
  for (const auto& [a, b] : {std::pair(1, 2), std::pair(2, 0)}) {
    const Eigen::Vector3d q = nearest_on_segment(p, t[a], t[b]);
    if ((q - p).squaredNorm() < (nearest - p).squaredNorm()) nearest = q;
  }
  return nearest;
}

/// What a query passes to its callback.
struct Query {
  const std::vector<Triangle>* triangles;
  Eigen::Vector3d p;
  NearestPoint nearest;
};

/// A little more, so that single precision loses no triangle.
float padded(double radius_m) {
  const double padded_m = radius_m * (1 + 1e-5) + 1e-5;
  return static_cast<float>(std::min<double>(padded_m, std::numeric_limits<float>::max()));
}

bool look_at_triangle(RTCPointQueryFunctionArguments* arguments) {
  Query& query = *static_cast<Query*>(arguments->userPtr);
  const Eigen::Vector3d q = nearest_on_triangle(query.p, (*query.triangles)[arguments->primID]);
  const double distance_m = (q - query.p).norm();
  if (!(distance_m < query.nearest.distance_m)) return false;
  query.nearest = {distance_m, q};
  arguments->query->radius = padded(distance_m);
  return true;
}

}  // namespace

struct NearestOnMesh::State {
  std::vector<Triangle> triangles;
  EmbreeDevice device;
  EmbreeScene scene;
};

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh) : state_(std::make_unique<State>()) {
  for (const auto& [a, b, c] : mesh.triangles) {
    state_->triangles.push_back({mesh.vertices_m[a].cast<double>(),
                                 mesh.vertices_m[b].cast<double>(),
                                 mesh.vertices_m[c].cast<double>()});
  }
  state_->device.reset(rtcNewDevice(nullptr));
  if (!state_->device) require_no_embree_error(nullptr, "making a device");
  state_->scene.reset(rtcNewScene(state_->device.get()));
  RTCGeometry geometry = rtcNewGeometry(state_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                               RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                               mesh.vertices_m.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), mesh.triangles.size()));
  require_no_embree_error(state_->device.get(), "allocating a mesh");
  for (const auto& p : mesh.vertices_m) vertices = std::copy(p.data(), p.data() + 3, vertices);
  for (const auto& t : mesh.triangles) indices = std::copy(t.begin(), t.end(), indices);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(state_->scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(state_->scene.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(state_->scene.get());
  require_no_embree_error(state_->device.get(), "building a scene");
}

NearestOnMesh::~NearestOnMesh() = default;
NearestOnMesh::NearestOnMesh(NearestOnMesh&&) noexcept = default;
NearestOnMesh& NearestOnMesh::operator=(NearestOnMesh&&) noexcept = default;

NearestPoint NearestOnMesh::operator()(const Eigen::Vector3d& p, double less_than_m) const {
  Query query{&state_->triangles, p, {less_than_m, {}}};
  RTCPointQuery point{};
  point.x = static_cast<float>(p.x());
  point.y = static_cast<float>(p.y());
  point.z = static_cast<float>(p.z());
  point.radius = padded(less_than_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(state_->scene.get(), &point, &context, look_at_triangle, &query);
  return query.nearest.distance_m < less_than_m ? query.nearest : NearestPoint{};
}

}  // namespace berth::testing
