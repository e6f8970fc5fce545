// Building blocks of the arm's links.
#pragma once

#include "sim/shapes.hpp"

namespace berth::sim {

/// Fineness of everything round.
inline constexpr int kSegments = 64;

/// The S-shaped shell of a link between an axis along z and one along y: from the origin, where it
/// faces -z, out towards -y, and back to (0, 0, height), where it faces +y. The radii are those of
/// its two ends.
TriangleMesh make_elbow(double height_m, double z_end_radius_m, double y_end_radius_m);

/// Turns an elbow of this height over: from an axis along y at the origin to one along z at the
/// height.
Pose upside_down(double height_m);

/// A ring with two grooves around z, from z = 0 upward, a little wider than the tube of this
/// radius.
TriangleMesh make_collar(double tube_radius_m);

/// A motor's cover: a bevelled disc on +z at z = 0, with screws.
TriangleMesh make_cover(double radius_m, int screws);

/// Screw heads in a circle around z, at height z.
TriangleMesh make_screws(int count, double circle_radius_m, double z_m);

}  // namespace berth::sim
