// The metric, over Number: float in namespace berth (metric.hpp includes this), and
// vectors of float in the namespace of each instruction set (metric_lanes-inl.hpp includes it
// again). Number has least, greatest and positive_part. As nobody contracts a * b + c, every
// instance computes the same bits.

/// How far the obstacle lies behind the robot; 0 for one in front of it, since what an obstacle
/// hides counts as obstacle (gray area, Hirt 2.14). NaN if either depth is.
inline Number depth_gap_m(Number robot_depth_m, Number obstacle_depth_m) {
  return positive_part(obstacle_depth_m - robot_depth_m);
}

/// Hirt 2.10 to 2.13. Pixels in the same column or row are both taken at their lower side.
inline FacingSides<Number> facing_sides(Number robot_px, Number obstacle_px) {
  const Number direction = least(Number(1), greatest(Number(-1), obstacle_px - robot_px));
  return {robot_px + greatest(Number(0), direction), obstacle_px - least(Number(0), direction)};
}

/// (o - c) (a + gap) - (r - c) a for the facing sides r and o, a the robot's depth: the offset from
/// robot point to obstacle point along one axis, before the division by the focal length. The form
/// below has no difference of large numbers.
inline Number axis_offset_px_m(FacingSides<Number> side, Number principal_px, Number robot_depth_m,
                               Number gap_m) {
  return (side.obstacle_px - side.robot_px) * robot_depth_m +
         (side.obstacle_px - principal_px) * gap_m;
}

/// The vector of a pair: robot pixel (ru, rv) and obstacle pixel (ou, ov), all whole numbers, and
/// their depths. NaN if either depth is.
inline BasicPairVector<Number> pair_vector(const BasicMetric<Number>& metric, Number ru, Number rv,
                                           Number robot_depth_m, Number ou, Number ov,
                                           Number obstacle_depth_m) {
  const Number gap_m = depth_gap_m(robot_depth_m, obstacle_depth_m);
  return {
      axis_offset_px_m(facing_sides(ru, ou), metric.cx_px, robot_depth_m, gap_m) * metric.inv_fx,
      axis_offset_px_m(facing_sides(rv, ov), metric.cy_px, robot_depth_m, gap_m) * metric.inv_fy,
      gap_m};
}

inline Number squared_length_m2(const BasicPairVector<Number>& v) {
  return v.x_m * v.x_m + v.y_m * v.y_m + v.z_m * v.z_m;
}

/// D^2 of a pair; arguments as for pair_vector.
inline Number squared_distance_m2(const BasicMetric<Number>& metric, Number ru, Number rv,
                                  Number robot_depth_m, Number ou, Number ov,
                                  Number obstacle_depth_m) {
  return squared_length_m2(pair_vector(metric, ru, rv, robot_depth_m, ou, ov, obstacle_depth_m));
}
