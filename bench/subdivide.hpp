#pragma once

#include "berth/robot/triangle_mesh.hpp"

namespace berth::bench {

/// Each triangle cut into four at the middles of its sides; the surface stays the same.
TriangleMesh subdivide(const TriangleMesh& mesh);

}  // namespace berth::bench
