// The lattice points of a list, of all links in any order.
#include "lattice_search.glsl"
#include "lattice_point.glsl"

layout(std430) readonly buffer LatticePoints { LatticePoint listed[]; };
layout(std430) readonly buffer LatticePointCount { uint point_count; };

uint find_candidates(uint link) { return point_count; }

bool is_candidate(uint link, uint i, out ivec2 pixel, out float depth_m) {
  LatticePoint point = listed[i];
  pixel = unpack(point.pixel);
  depth_m = point.depth_m;
  return point.link == link;
}
