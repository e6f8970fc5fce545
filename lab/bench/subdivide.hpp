#pragma once

#include "berth/robot/triangle_mesh.hpp"

namespace berth::lab {

/// The same surface with parts * parts triangles in place of each one: every edge in `parts` equal
/// parts. Neighbours share positions to the bit, though not vertices.
TriangleMesh subdivide(const TriangleMesh& mesh, int parts);

}  // namespace berth::lab
