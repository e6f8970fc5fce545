#include "berth/robot/plausible_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace berth {
namespace {

constexpr double kFarthestLink_m = 100;
constexpr double kFarthestAnything_m = 1e5;

bool has_area(const TriangleMesh& mesh_L) {
  return std::any_of(mesh_L.triangles.begin(), mesh_L.triangles.end(), [&](const auto& triangle) {
    const auto p = [&](int i) -> Eigen::Vector3d {
      return mesh_L.vertices_m[triangle[static_cast<std::size_t>(i)]].template cast<double>();
    };
    return (p(1) - p(0)).cross(p(2) - p(0)).squaredNorm() > 0;
  });
}

}  // namespace

double reach_m(const TriangleMesh& mesh) {
  double reach = 0;
  for (const Eigen::Vector3f& p : mesh.vertices_m) {
    const double distance = p.cast<double>().norm();
    if (!std::isfinite(distance)) return distance;
    reach = std::max(reach, distance);
  }
  return reach;
}

void require_plausible_size(const std::filesystem::path& file, const RobotModel& model) {
  for (const Link& link : model.links) {
    const auto fail = [&](const std::string& what) {
      throw std::runtime_error(fmt::format("{}: link \"{}\": {}", file.string(), link.name, what));
    };
    const double offset_m = link.joint.X_PJ.translation().norm();
    if (!(offset_m <= kFarthestAnything_m)) {
      fail(fmt::format("joint \"{}\" is {:g} m from its parent; expected at most {:g} m",
                       link.joint.name, offset_m, kFarthestAnything_m));
    }
    if (link.mesh_L.empty()) continue;
    const bool evaluated = link.role == LinkRole::evaluated;
    const double most_m = evaluated ? kFarthestLink_m : kFarthestAnything_m;
    if (const double reach = reach_m(link.mesh_L); !(reach <= most_m)) {
      fail(
          fmt::format("reaches {:g} m from its origin; expected at most {:g} m (a mesh in "
                      "millimetres needs scale=\"0.001 0.001 0.001\")",
                      reach, most_m));
    }
    if (!has_area(link.mesh_L)) fail("no triangle has an area; expected one at least");
  }
}

}  // namespace berth
