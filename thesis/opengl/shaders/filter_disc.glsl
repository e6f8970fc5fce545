// How far an outline pixel grows in the image.
uniform dvec2 focal_px;

// A length at this depth, in pixels to the side and along.
dvec2 disc_radius_px(double radius_m, float depth_m, ivec2 size) {
  double longest_px = double(max(size.x, size.y));
  precise dvec2 radius_px = min(dvec2(longest_px), radius_m * focal_px / double(depth_m));
  return radius_px;
}

// A pixel more than needed, against rounding.
uint reach_of(dvec2 radius_px) { return uint(max(radius_px.x, radius_px.y)) + 2u; }

Disc with_radius(Disc disc, dvec2 radius_px) {
  disc.radius2_px2 = -1.0LF;
  disc.squash = 1.0LF;
  if (!(radius_px.x > 0.0LF)) return disc;
  // Keeps a pixel that is as far away as the radius itself.
  const double kRoundingMargin = 1.0LF + 1e-9LF;
  precise double ratio = radius_px.x / radius_px.y;
  precise double radius2_px2 = radius_px.x * radius_px.x * kRoundingMargin;
  precise double squash = ratio * ratio;
  disc.radius2_px2 = radius2_px2;
  disc.squash = squash;
  return disc;
}
