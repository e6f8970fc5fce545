// The closest pair of a link's candidates and a slice of the obstacle image; workgroup (slice, link),
// and on to further links where there are more than workgroups. The file that includes this defines the candidates. A pair takes the place of the closest of the
// searches before only if it is closer.
#include "metric.glsl"
#include "pixels.glsl"
#include "closest_pair.glsl"
#include "visible_links.glsl"

layout(local_size_x = 256) in;

uniform sampler2D obstacle_depth_m;
uniform ivec2 step_px;       // every Nth column and row of obstacle pixels is tried
uniform float farthest_m2;   // a pair has to be closer
uniform uint former_slices;  // of the search before; 0 in the first
// Of each link as many as the search has slices.
layout(std430) readonly buffer FormerClosest { ClosestPair former_closest[]; };
layout(std430) writeonly buffer SliceClosest { ClosestPair slice_closest[]; };
// Of each link the lower and the upper half of a 64-bit number.
layout(std430) buffer LinkPairs { uint link_pairs[]; };

const uint kThreads = 256u;
const uint kMostPoints = 512u;

shared ClosestPair former;
shared uint points;
shared ivec2 point_px[kMostPoints];
shared float point_m[kMostPoints];
shared ivec2 point_offset[kMostPoints];
shared uint pairs;

bool has_pair(ClosestPair pair) { return pair.robot_depth_m > 0.0; }

// Called by all invocations, with the same link; returns the same number to all.
uint find_candidates(uint link);
// Whether candidate i is a pixel of the link.
bool is_candidate(uint link, uint i, out ivec2 pixel, out float depth_m);

void find_former(uint link) {
  ClosestPair own = no_pair();
  for (uint i = gl_LocalInvocationIndex; i < former_slices; i += kThreads) {
    ClosestPair pair = former_closest[link * former_slices + i];
    if (is_closer(pair, own)) own = pair;
  }
  if (is_closest_of_workgroup(own) || (!workgroup_has_pair() && gl_LocalInvocationIndex == 0)) {
    former = own;
  }
  barrier();
}

void try_pair(uint i, ivec2 pixel, float depth_m, float below_m2, inout ClosestPair best) {
  float m2 = squared_distance_m2(point_px[i], point_m[i], pixel, depth_m);
  if (m2 >= below_m2 || m2 > best.squared_m2) return;
  ClosestPair pair = ClosestPair(m2, point_m[i], depth_m, pack(point_px[i]), pack(pixel));
  if (is_closer(pair, best)) best = pair;
}

// The obstacle pixel of this cell of step_px pixels for each gathered robot pixel: the steps count
// from the robot pixel's column and row, so that other points meet other obstacle pixels. Returns
// the number of pairs.
uint try_cell(ivec2 corner, uint count, float below_m2, inout ClosestPair best) {
  ivec2 size = textureSize(obstacle_depth_m, 0);
  ivec2 offset = ivec2(-1);
  ivec2 pixel;
  float depth_m;
  uint own_pairs = 0u;
  for (uint i = 0u; i < count; ++i) {
    if (point_offset[i] != offset) {
      offset = point_offset[i];
      pixel = corner + offset;
      depth_m = all(lessThan(pixel, size)) ? texelFetch(obstacle_depth_m, pixel, 0).x : 0.0;
    }
    if (!(depth_m > 0.0)) continue;
    try_pair(i, pixel, depth_m, below_m2, best);
    ++own_pairs;
  }
  return own_pairs;
}

void try_slice(uint count, inout ClosestPair best) {
  float below_m2 = has_pair(former) ? former.squared_m2 : farthest_m2;
  uvec2 cells = uvec2((textureSize(obstacle_depth_m, 0) + step_px - 1) / step_px);
  uint own_pairs = 0u;
  for (uint i = gl_WorkGroupID.x * kThreads + gl_LocalInvocationIndex; i < cells.x * cells.y;
       i += gl_NumWorkGroups.x * kThreads) {
    own_pairs += try_cell(step_px * ivec2(i % cells.x, i / cells.x), count, below_m2, best);
  }
  atomicAdd(pairs, own_pairs);
}

void add_pairs(uint link) {
  uint before = atomicAdd(link_pairs[2u * link], pairs);
  if (before + pairs < before) atomicAdd(link_pairs[2u * link + 1u], 1u);
}

void try_candidates(uint link, inout ClosestPair best) {
  uint count = find_candidates(link);
  if (gl_LocalInvocationIndex == 0) {
    points = 0u;
    pairs = 0u;
  }
  barrier();
  for (uint base = 0u; base < count; base += kThreads) {
    uint i = base + gl_LocalInvocationIndex;
    ivec2 pixel;
    float depth_m;
    if (i < count && is_candidate(link, i, pixel, depth_m)) {
      uint place = atomicAdd(points, 1u);
      point_px[place] = pixel;
      point_m[place] = depth_m;
      point_offset[place] = pixel % step_px;
    }
    barrier();
    uint gathered = points;
    bool is_full = gathered + kThreads > kMostPoints;
    if (is_full || base + kThreads >= count) {
      try_slice(gathered, best);
      barrier();
      if (gl_LocalInvocationIndex == 0) {
        add_pairs(link);
        points = 0u;
        pairs = 0u;
      }
    }
    barrier();
  }
}

void search(uint link) {
  find_former(link);
  ClosestPair best = no_pair();
  if (gl_WorkGroupID.x == 0u && gl_LocalInvocationIndex == 0u) best = former;
  try_candidates(link, best);
  if (is_closest_of_workgroup(best) || (!workgroup_has_pair() && gl_LocalInvocationIndex == 0)) {
    slice_closest[link * gl_NumWorkGroups.x + gl_WorkGroupID.x] = best;
  }
  barrier();
}

void main() {
  uint stride = gl_NumWorkGroups.y;
  for (uint link = visible_from(gl_WorkGroupID.y, stride); link < link_count;
       link = visible_from(link + stride, stride)) {
    search(link);
  }
}
