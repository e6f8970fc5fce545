// A lower bound of D^2 over the pairs of two boxes of pixels, as in distance/lower_bound.hpp.

struct PixelBox {
  vec2 lo_px;  // the sides of all pixels lie in [lo_px, hi_px]
  vec2 hi_px;
  float depth_lo_m;
  float depth_hi_m;
};

vec2 least_product(vec2 k, float lo, float hi) { return min(k * lo, k * hi); }

// Holds for pairs whose depth gap is at most max_gap_m; others are no closer than that.
float lower_bound_m2(PixelBox robot, PixelBox obstacle, float max_gap_m) {
  float gap_lo_m = depth_gap_m(robot.depth_hi_m, obstacle.depth_lo_m);
  float gap_hi_m = min(max_gap_m, depth_gap_m(robot.depth_lo_m, obstacle.depth_hi_m));
  vec2 rightward =
      least_product(obstacle.lo_px - robot.hi_px, robot.depth_lo_m, robot.depth_hi_m) +
      least_product(obstacle.lo_px - intrinsics.xy, gap_lo_m, gap_hi_m);
  vec2 leftward = least_product(robot.lo_px - obstacle.hi_px, robot.depth_lo_m, robot.depth_hi_m) +
                  least_product(intrinsics.xy - obstacle.hi_px, gap_lo_m, gap_hi_m);
  vec2 offset_m = max(max(rightward, leftward), 0.0) * intrinsics.zw;
  return dot(offset_m, offset_m) + gap_lo_m * gap_lo_m;
}
