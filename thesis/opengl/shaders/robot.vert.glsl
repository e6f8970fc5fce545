// The robot's triangles in the camera's image.
#include "robot_triangle.glsl"

// The triangle's corners and normals: at its last vertex, whose plane counts, that of this vertex
// last.
layout(location = 0) in vec3 corner_0_L_m;
layout(location = 1) in vec3 corner_1_L_m;
layout(location = 2) in vec3 corner_2_L_m;
layout(location = 3) in vec3 normal_0_L;
layout(location = 4) in vec3 normal_1_L;
layout(location = 5) in vec3 normal_2_L;

uniform mat4 X_CL;
uniform mat4 to_clip_C;   // a point of frame C with a 1, to clip coordinates
uniform vec4 centre_L_m;  // of the link's surface
uniform float model_scale;
uniform float normal_padding_m;

flat out vec2 anchor;
flat out vec3 inverse_depth;
flat out vec2 inverse_depth_range;

vec3 enlarged_C_m(vec3 corner_L_m, vec3 normal_L) {
  vec3 p_L_m = corner_L_m;
  if (model_scale != 1.0) p_L_m = centre_L_m.xyz + model_scale * (corner_L_m - centre_L_m.xyz);
  return (X_CL * vec4(p_L_m + normal_padding_m * normal_L, 1.0)).xyz;
}

void main() {
  vec3 p_m[3] = vec3[3](enlarged_C_m(corner_0_L_m, normal_0_L),
                        enlarged_C_m(corner_1_L_m, normal_1_L),
                        enlarged_C_m(corner_2_L_m, normal_2_L));
  gl_Position = to_clip_C * vec4(p_m[2], 1.0);

  // 1 / z is linear in the image; from the farthest corner, which is not behind the camera.
  vec3 normal = cross(p_m[1] - p_m[0], p_m[2] - p_m[0]);
  vec3 from_m = p_m[0].z > p_m[1].z ? p_m[0] : p_m[1];
  if (p_m[2].z > from_m.z) from_m = p_m[2];
  float offset = dot(normal, from_m);
  anchor = from_m.xy / from_m.z;
  inverse_depth = vec3(1.0 / from_m.z, offset == 0.0 ? vec2(0.0) : normal.xy / offset);
  float nearest_m = min(min(p_m[0].z, p_m[1].z), p_m[2].z);
  inverse_depth_range = vec2(1.0 / from_m.z, nearest_m > kNear_m ? 1.0 / nearest_m : 1.0 / kNear_m);
}
