#include "sim/nearest_on_mesh.hpp"

#include <algorithm>

namespace berth::sim {
namespace {

using Corners = NearestOnMesh::Corners;

Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a,
                                   const Eigen::Vector3d& b) {
  const double length2 = (b - a).squaredNorm();
  if (length2 == 0) return a;
  return a + std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) * (b - a);
}

/// Whether p lies over the triangle's inside, along its normal.
bool is_over(const Eigen::Vector3d& p, const Corners& t, const Eigen::Vector3d& normal) {
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d& a = t[i];
    const Eigen::Vector3d& b = t[(i + 1) % 3];
    if ((b - a).cross(p - a).dot(normal) < 0) return false;
  }
  return true;
}

Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Corners& t) {
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
  const std::vector<Corners>* triangles;
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

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh)
    : device_(make_embree_device()), scene_(rtcNewScene(device_.get())) {
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles_.push_back({mesh.vertices_m[a].cast<double>(), mesh.vertices_m[b].cast<double>(),
                          mesh.vertices_m[c].cast<double>()});
  }
  attach_mesh(device_.get(), scene_.get(), 0, mesh);
  rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
  commit_scene(device_.get(), scene_.get());
}

NearestPoint NearestOnMesh::operator()(const Eigen::Vector3d& p, double less_than_m) const {
  Query query{&triangles_, p, {less_than_m, {}}};
  RTCPointQuery point{};
  point.x = static_cast<float>(p.x());
  point.y = static_cast<float>(p.y());
  point.z = static_cast<float>(p.z());
  point.radius = padded(less_than_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(scene_.get(), &point, &context, look_at_triangle, &query);
  return query.nearest.distance_m < less_than_m ? query.nearest : NearestPoint{};
}

}  // namespace berth::sim
