#pragma once

#include "berth/robot/triangle_mesh.hpp"

namespace berth::lab {

/// Fewer triangles of about the same shape: the vertices in each cube of side cell_m become one, at
/// their mean, and triangles that lose a corner fall away. No vertex moves by more than the cube's
/// diagonal.
TriangleMesh coarsen(const TriangleMesh& mesh, float cell_m);

}  // namespace berth::lab
