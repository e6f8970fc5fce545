#include "sim/arm_shells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berth::sim {
namespace {

using std::numbers::pi;

// A path in the yz plane; the heading is measured from +z towards +y.
struct PathPoint {
  double y_m, z_m, heading_rad;
};
using Path = std::vector<PathPoint>;

// Goes on from the path's end along an arc that ends with the given heading.
void add_arc(Path& path, double arc_radius_m, double end_heading_rad, int steps) {
  const PathPoint from = path.back();
  const double turn = end_heading_rad - from.heading_rad;
  const double side = turn > 0 ? arc_radius_m : -arc_radius_m;
  for (int i = 1; i <= steps; ++i) {
    const double heading = from.heading_rad + turn * i / steps;
    path.push_back({from.y_m + side * (std::cos(from.heading_rad) - std::cos(heading)),
                    from.z_m + side * (std::sin(heading) - std::sin(from.heading_rad)), heading});
  }
}

// 60 degrees out and 150 back end on the axis again, for any radius of the arcs.
Path elbow_path(double height_m, double arc_radius_m) {
  const double arcs_height = arc_radius_m * (1 + 2 * std::sin(pi / 3));
  Path path{{0, 0, 0}, {0, 0.5 * (height_m - arcs_height), 0}, {0, height_m - arcs_height, 0}};
  add_arc(path, arc_radius_m, -pi / 3, 12);
  add_arc(path, arc_radius_m, pi / 2, 30);
  return path;
}

Ring make_ring(const PathPoint& at, double radius_m) {
  const Eigen::Vector3d centre(0, at.y_m, at.z_m);
  const Eigen::Vector3d side(0, std::cos(at.heading_rad), -std::sin(at.heading_rad));
  Ring ring(kSegments);
  for (int i = 0; i < kSegments; ++i) {
    const double angle = 2 * pi * i / kSegments;
    ring[i] =
        centre + radius_m * (std::cos(angle) * Eigen::Vector3d::UnitX() + std::sin(angle) * side);
  }
  return ring;
}

TriangleMesh make_screw_head() {
  const Profile head{{0.0040, -0.001}, {0.0040, 0.0022}, {0.0034, 0.0030},
                     {0.0022, 0.0030}, {0.0020, 0.0012}, {0, 0.0012}};
  return make_lathe(head, 12);
}

}  // namespace

TriangleMesh make_elbow(double height_m, double z_end_radius_m, double y_end_radius_m) {
  // Arcs tighter than the tube would fold its inner side.
  const Path path = elbow_path(height_m, std::max(z_end_radius_m, y_end_radius_m) + 0.002);
  std::vector<Ring> rings{make_ring(path.front(), 0)};
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double t = static_cast<double>(i) / (path.size() - 1);
    rings.push_back(make_ring(path[i], z_end_radius_m + t * (y_end_radius_m - z_end_radius_m)));
  }
  rings.push_back(make_ring(path.back(), 0));
  return make_skin(rings);
}

Pose upside_down(double height_m) {
  return translation(0, 0, height_m) * rotation(pi, Eigen::Vector3d::UnitX());
}

TriangleMesh make_collar(double tube_radius_m) {
  const double r = tube_radius_m, out = r + 0.0035, in = r + 0.0005;
  return make_lathe({{r - 0.010, 0.0005},
                     {out - 0.001, 0.0005},
                     {out, 0.0015},
                     {out, 0.007},
                     {in, 0.007},
                     {in, 0.009},
                     {out, 0.009},
                     {out, 0.014},
                     {in, 0.014},
                     {in, 0.016},
                     {out, 0.016},
                     {out, 0.019},
                     {out - 0.002, 0.021},
                     {r - 0.010, 0.021}},
                    kSegments);
}

TriangleMesh make_screws(int count, double circle_radius_m, double z_m) {
  TriangleMesh screws;
  const TriangleMesh head = make_screw_head();
  for (int i = 0; i < count; ++i)
    append(screws, head,
           rotation(2 * pi * i / count, Eigen::Vector3d::UnitZ()) *
               translation(circle_radius_m, 0, z_m));
  return screws;
}

TriangleMesh make_cover(double radius_m, int screws) {
  const double r = radius_m;
  TriangleMesh cover = make_lathe({{r, -0.062},
                                   {r, 0.000},
                                   {r - 0.001, 0.003},
                                   {r - 0.004, 0.005},
                                   {0.55 * r, 0.005},
                                   {0.53 * r, 0.003},
                                   {0.45 * r, 0.003},
                                   {0.43 * r, 0.006},
                                   {0, 0.007}},
                                  kSegments);
  append(cover, make_screws(screws, 0.77 * r, 0.005));
  return cover;
}

}  // namespace berth::sim
