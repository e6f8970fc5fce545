// R and I of the nearest surface.
#include "robot_fragment.glsl"

uniform uint link_id;

layout(location = 0) out float robot_depth_m;
layout(location = 1) out uint robot_link_id;

void main() {
  float here = inverse_depth_here();
  robot_depth_m = 1.0 / here;
  robot_link_id = link_id;
  gl_FragDepth = kNear_m * here;
}
