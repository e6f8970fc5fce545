// The closest pair of each link, of those of its slices; one workgroup a link, and on to further
// links where there are more than workgroups.
#include "pixels.glsl"
#include "closest_pair.glsl"
#include "visible_links.glsl"
#include "link_answer.glsl"
#include "region_of_surveillance.glsl"

layout(local_size_x = 64) in;

uniform ivec2 image_size;
uniform uint slices;
layout(std430) readonly buffer SliceClosest { ClosestPair slice_closest[]; };
layout(std430) readonly buffer LinkPairs { uint link_pairs[]; };
layout(std430) writeonly buffer LinkAnswers { LinkAnswer answers[]; };

void write(uint link, ClosestPair pair, ivec4 region, float max_depth_m) {
  answers[link] = LinkAnswer(pair, link_pixels[link], link_pairs[2u * link],
                             link_pairs[2u * link + 1u], region.x, region.y, region.z, region.w,
                             max_depth_m);
}

ClosestPair closest_of_slices(uint link) {
  ClosestPair best = no_pair();
  for (uint i = gl_LocalInvocationIndex; i < slices; i += gl_WorkGroupSize.x) {
    ClosestPair pair = slice_closest[link * slices + i];
    if (is_closer(pair, best)) best = pair;
  }
  return best;
}

void finish(uint link) {
  ClosestPair best = closest_of_slices(link);
  if (is_closest_of_workgroup(best)) {
    ivec4 region = region_of_surveillance(unpack(best.robot), best.robot_depth_m, image_size);
    write(link, best, region, float(double(best.robot_depth_m) + range_m));
  } else if (!workgroup_has_pair() && gl_LocalInvocationIndex == 0) {
    write(link, no_pair(), ivec4(0), 0.0);
  }
  barrier();
}

void main() {
  uint stride = gl_NumWorkGroups.x;
  for (uint link = visible_from(gl_WorkGroupID.x, stride); link < link_count;
       link = visible_from(link + stride, stride)) {
    finish(link);
  }
  for (uint link = gl_GlobalInvocationID.x; link < link_count; link += stride * gl_WorkGroupSize.x) {
    if (link_pixels[link] == 0u) write(link, no_pair(), ivec4(0), 0.0);
  }
}
