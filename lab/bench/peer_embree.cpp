// Embree's closest-point query over the obstacle points; Open3D's RaycastingScene asks it too.

#include <cmath>

#include "lab/bench/peer.hpp"
#include "lab/bench/points.hpp"
#include "sim/embree.hpp"
#include "sim/embree_scene.hpp"

namespace berth::lab {
namespace {

void point_bounds(const RTCBoundsFunctionArguments* arguments) {
  const Point& p = static_cast<const Point*>(arguments->geometryUserPtr)[arguments->primID];
  RTCBounds& box = *arguments->bounds_o;
  box.lower_x = box.upper_x = p[0];
  box.lower_y = box.upper_y = p[1];
  box.lower_z = box.upper_z = p[2];
}

/// One link's search.
struct Closest {
  const Point* points_C_m;
  bool found;
};

/// Shrinks the query's radius to the point.
bool try_point(RTCPointQueryFunctionArguments* arguments) {
  auto& closest = *static_cast<Closest*>(arguments->userPtr);
  RTCPointQuery& query = *arguments->query;
  const Point& p = closest.points_C_m[arguments->primID];
  const float x = p[0] - query.x;
  const float y = p[1] - query.y;
  const float z = p[2] - query.z;
  const float distance_m = std::sqrt(x * x + y * y + z * z);
  if (!(distance_m < query.radius)) return false;
  query.radius = distance_m;
  closest.found = true;
  return true;
}

class EmbreePeer : public Peer {
 public:
  std::string name() const override { return "Embree closest point"; }
  std::string lacks() const override { return "gray area, pixel sizes"; }

  void prepare(const BenchScene& scene) override {
    collect_obstacle_points(scene, points_C_m_);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(points_C_m_.size()));
    rtcSetGeometryUserData(geometry, points_C_m_.data());
    rtcSetGeometryBoundsFunction(geometry, point_bounds, nullptr);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_LOW);
    rtcCommitGeometry(geometry);
    scene_.reset(rtcNewScene(device_.get()));
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_LOW);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
  }

  void evaluate(const BenchScene& scene, PeerDistances& distances_m) override {
    collect_robot_points(scene, robot_C_m_);
    distances_m.clear();
    for (const std::vector<Point>& link : robot_C_m_) distances_m.push_back(ask(scene, link));
  }

 private:
  std::optional<float> ask(const BenchScene& scene, const std::vector<Point>& link) const {
    Closest closest{points_C_m_.data(), false};
    auto radius_m = static_cast<float>(scene.range_m);
    for (const Point& p : link) {
      RTCPointQuery query{p[0], p[1], p[2], 0, radius_m};
      RTCPointQueryContext context;
      rtcInitPointQueryContext(&context);
      rtcPointQuery(scene_.get(), &query, &context, try_point, &closest);
      radius_m = query.radius;
    }
    return closest.found ? std::optional(radius_m) : std::nullopt;
  }

  std::vector<Point> points_C_m_;
  sim::EmbreeDevice device_{rtcNewDevice(nullptr)};
  sim::EmbreeScene scene_;
  std::vector<std::vector<Point>> robot_C_m_;
};

}  // namespace

std::unique_ptr<Peer> make_embree() { return std::make_unique<EmbreePeer>(); }

}  // namespace berth::lab
