// The distance of a robot pixel and an obstacle pixel (Hirt 2.10 to 2.14), as in distance/metric.hpp.

// Principal point in the corner convention, in pixels; one over the focal lengths.
uniform vec4 intrinsics;

// How far the obstacle lies behind the robot; 0 for one in front of it (gray area, Hirt 2.14).
float depth_gap_m(float robot_depth_m, float obstacle_depth_m) {
  return max(obstacle_depth_m - robot_depth_m, 0.0);
}

// From the robot point to the obstacle point of a pair, in the optical frame. Pixels face each other
// with the sides of Hirt 2.10 to 2.13.
vec3 pair_vector_m(ivec2 robot, float robot_depth_m, ivec2 obstacle, float obstacle_depth_m) {
  ivec2 direction = clamp(obstacle - robot, -1, 1);
  vec2 robot_side = vec2(robot + max(direction, 0));
  vec2 obstacle_side = vec2(obstacle - min(direction, 0));
  float gap_m = depth_gap_m(robot_depth_m, obstacle_depth_m);
  precise vec2 offset_m = ((obstacle_side - robot_side) * robot_depth_m +
                           (obstacle_side - intrinsics.xy) * gap_m) * intrinsics.zw;
  return vec3(offset_m, gap_m);
}

// D^2 of a pair.
float squared_distance_m2(ivec2 robot, float robot_depth_m, ivec2 obstacle, float obstacle_depth_m) {
  vec3 v = pair_vector_m(robot, robot_depth_m, obstacle, obstacle_depth_m);
  precise float squared_m2 = v.x * v.x + v.y * v.y + v.z * v.z;
  return squared_m2;
}
