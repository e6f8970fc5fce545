// A reading belongs to a surface unless it is nearer by more than x + y z + z z^2, as in
// self_filter/settings.hpp.
uniform vec4 tolerance;

float least_reading_m(float z_m) {
  precise float least_m = z_m - (tolerance.x + (tolerance.y * z_m + tolerance.z * z_m * z_m));
  return least_m;
}

// The greatest reading that may be on a surface; a deeper one lies behind it.
float greatest_reading_m(float z_m) {
  precise float greatest_m = z_m + (tolerance.x + (tolerance.y * z_m + tolerance.z * z_m * z_m));
  return greatest_m;
}
