// The projection of a cube of half side range_m around a robot pixel (Hirt algorithm 1), as in
// distance/region_of_surveillance.cpp and in doubles like there: both have to name the same pixels.
uniform dvec4 pinhole;  // principal point in the corner convention, and focal lengths, in pixels
uniform double range_m;

// First pixel along one axis, and one after the last.
ivec2 project(double pixel, double z_m, double f_px, double principal_px, int size_px) {
  precise double lower_px_m = (pixel - principal_px) * z_m - f_px * range_m;
  precise double upper_px_m = (pixel + 1.0LF - principal_px) * z_m + f_px * range_m;
  precise double front_m = z_m - range_m;
  precise double back_m = z_m + range_m;
  precise double lower_px = lower_px_m / (lower_px_m > 0.0LF ? back_m : front_m) + principal_px;
  precise double upper_px = upper_px_m / (upper_px_m > 0.0LF ? front_m : back_m) + principal_px;
  const double kBorderPx = 1e-6LF;
  double size = double(size_px);
  return ivec2(clamp(floor(lower_px - kBorderPx), 0.0LF, size),
               clamp(floor(upper_px + kBorderPx) + 1.0LF, 0.0LF, size));
}

// u_begin, v_begin, u_end, v_end.
ivec4 region_of_surveillance(ivec2 robot_pixel, float depth_m, ivec2 size) {
  double z_m = double(depth_m);
  if (z_m <= range_m) return ivec4(0, 0, size);
  ivec2 u = project(double(robot_pixel.x), z_m, pinhole.z, pinhole.x, size.x);
  ivec2 v = project(double(robot_pixel.y), z_m, pinhole.w, pinhole.y, size.y);
  return ivec4(u.x, v.x, u.y, v.y);
}
