// The depth of the robot's triangle at a pixel's centre. OpenGL's own interpolation starts from
// corners that were moved to the next 1/256 px, which is too coarse where a surface turns away.
#include "robot_triangle.glsl"

// The triangle as a function over the image, of which a point is x / z, y / z in frame C:
// 1 / z = inverse_depth.x + dot(inverse_depth.yz, point - anchor).
flat in vec2 anchor;
flat in vec3 inverse_depth;
flat in vec2 inverse_depth_range;  // least and greatest of the corners

uniform vec4 pinhole;  // principal point, pixels from the corner of the image; one over the focal lengths

float inverse_depth_here() {
  vec2 point = (gl_FragCoord.xy - pinhole.xy) * pinhole.zw;
  float here = inverse_depth.x + dot(inverse_depth.yz, point - anchor);
  return clamp(here, inverse_depth_range.x, inverse_depth_range.y);
}
