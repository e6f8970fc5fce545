// Sums of the unit vectors from each link's closest robot pixel to the obstacle pixels in its region
// of surveillance (Hirt 2.2.5). Workgroup (i, link) takes every gl_NumWorkGroups.x-th row.
#include "metric.glsl"
#include "pixels.glsl"
#include "closest_pair.glsl"
#include "link_answer.glsl"

layout(local_size_x = 128) in;

uniform sampler2D obstacle_depth_m;
layout(std430) readonly buffer LinkAnswers { LinkAnswer answers[]; };
// x, y, z and the count of each workgroup, a row of gl_NumWorkGroups.x for each link.
layout(std430) writeonly buffer DirectionSums { vec4 sums[]; };

const uint kThreads = 128u;
shared vec4 partial[kThreads];

vec4 direction(ClosestPair pair, float max_depth_m, ivec2 pixel) {
  float depth_m = texelFetch(obstacle_depth_m, pixel, 0).x;
  if (!(depth_m > 0.0) || depth_m > max_depth_m) return vec4(0.0);
  vec3 vector = pair_vector_m(unpack(pair.robot), pair.robot_depth_m, pixel, depth_m);
  float squared_m2 = dot(vector, vector);
  return squared_m2 > 0.0 ? vec4(vector * inversesqrt(squared_m2), 1.0) : vec4(0.0);
}

void main() {
  uint link = gl_WorkGroupID.y;
  LinkAnswer answer = answers[link];
  vec4 sum = vec4(0.0);
  for (int v = answer.v_begin + int(gl_WorkGroupID.x); v < answer.v_end; v += int(gl_NumWorkGroups.x)) {
    for (int u = answer.u_begin + int(gl_LocalInvocationIndex); u < answer.u_end; u += int(kThreads)) {
      sum += direction(answer.pair, answer.max_depth_m, ivec2(u, v));
    }
  }
  partial[gl_LocalInvocationIndex] = sum;
  for (uint width = kThreads / 2u; width > 0u; width /= 2u) {
    barrier();
    if (gl_LocalInvocationIndex < width) {
      partial[gl_LocalInvocationIndex] += partial[gl_LocalInvocationIndex + width];
    }
  }
  if (gl_LocalInvocationIndex == 0) sums[link * gl_NumWorkGroups.x + gl_WorkGroupID.x] = partial[0];
}
