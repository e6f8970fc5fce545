// The lower bound over the Number of metric_formula-inl.hpp; included in the same way.

/// The least k x over x in the interval.
inline Number least_product(Number k, Interval<Number> x) { return least(k * x.lo, k * x.hi); }

/// The least magnitude of axis_offset_px_m, over robot sides, obstacle sides, robot depths and
/// depth gaps.
inline Number least_axis_offset_px_m(Interval<Number> robot_px, Interval<Number> obstacle_px,
                                     Number principal_px, Interval<Number> robot_depth_m,
                                     Interval<Number> gap_m) {
  const Number rightward = least_product(obstacle_px.lo - robot_px.hi, robot_depth_m) +
                           least_product(obstacle_px.lo - principal_px, gap_m);
  const Number leftward = least_product(robot_px.lo - obstacle_px.hi, robot_depth_m) +
                          least_product(principal_px - obstacle_px.hi, gap_m);
  return greatest(Number(0), greatest(rightward, leftward));
}

/// At most the D^2 of every pair of the two boxes whose depth gap is at most max_gap_m. With
/// max_gap_m the best distance so far, pairs that this leaves out are no closer; so a result that
/// is not below the best D^2 so far means that no pair of the boxes improves on it. An empty box
/// gives +inf or NaN.
///
/// It errs on the safe side of rounding, without a tolerance: it does the metric's operations in
/// the metric's order, each on operands that bound the metric's. Rounding is monotone, so each
/// rounded result bounds the metric's rounded result too. (Differences of whole pixel coordinates
/// are exact, and leftward is the negated offset: rounding is symmetric.)
inline Number lower_bound_m2(const BasicMetric<Number>& metric, const BasicPixelBox<Number>& robot,
                             const BasicPixelBox<Number>& obstacle, Number max_gap_m) {
  const Interval<Number> robot_depth_m{robot.depth_lo_m, robot.depth_hi_m};
  const Interval<Number> gap_m{
      depth_gap_m(robot.depth_hi_m, obstacle.depth_lo_m),
      least(max_gap_m, depth_gap_m(robot.depth_lo_m, obstacle.depth_hi_m))};
  const Number x_px_m = least_axis_offset_px_m(
      {robot.u_lo, robot.u_hi}, {obstacle.u_lo, obstacle.u_hi}, metric.cx_px, robot_depth_m, gap_m);
  const Number y_px_m = least_axis_offset_px_m(
      {robot.v_lo, robot.v_hi}, {obstacle.v_lo, obstacle.v_hi}, metric.cy_px, robot_depth_m, gap_m);
  return squared_length_m2(
      BasicPairVector<Number>{x_px_m * metric.inv_fx, y_px_m * metric.inv_fy, gap_m.lo});
}
