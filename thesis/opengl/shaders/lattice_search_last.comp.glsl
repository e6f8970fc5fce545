// All pixels of the link within a radius of its closest lattice point.
#include "lattice_search.glsl"

uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
uniform int radius_px;  // at most 65535

ivec2 window_begin() { return max(unpack(former.robot) - radius_px, ivec2(0)); }

ivec2 window_size() {
  ivec2 end = min(unpack(former.robot) + radius_px + 1, textureSize(link_id, 0));
  return end - window_begin();
}

uint find_candidates(uint link) {
  if (!has_pair(former)) return 0u;
  ivec2 size = window_size();
  return uint(size.x) * uint(size.y);
}

bool is_candidate(uint link, uint i, out ivec2 pixel, out float depth_m) {
  uint width = uint(window_size().x);
  pixel = window_begin() + ivec2(i % width, i / width);
  depth_m = texelFetch(robot_depth_m, pixel, 0).x;
  uvec2 away = uvec2(abs(pixel - unpack(former.robot)));
  bool is_within = away.x * away.x + away.y * away.y <= uint(radius_px) * uint(radius_px);
  return is_within && texelFetch(link_id, pixel, 0).x == link + 1u;
}
