// R and I of the nearest surface, and the sensor's depth without it, in one pass (Hirt 3.1.1).
#include "robot_fragment.glsl"
#include "tolerance.glsl"

uniform uint link_id;
uniform sampler2D sensor_depth_m;

layout(location = 0) out float robot_depth_m;
layout(location = 1) out uint robot_link_id;
layout(location = 2) out float filtered_depth_m;

void main() {
  float here = inverse_depth_here();
  float depth_m = 1.0 / here;
  float reading_m = texelFetch(sensor_depth_m, ivec2(gl_FragCoord.xy), 0).x;
  robot_depth_m = depth_m;
  robot_link_id = link_id;
  filtered_depth_m = reading_m >= least_reading_m(depth_m) ? 0.0 : reading_m;
  gl_FragDepth = kNear_m * here;
}
