// Points in space as in self_filter/near_surface.cpp, and boxes around those of a workgroup.
uniform dvec4 camera;  // principal point where whole numbers are pixel centres, and focal lengths, in pixels

vec3 point_m(ivec2 pixel, float depth_m) {
  precise vec2 ray = vec2((dvec2(pixel) - camera.xy) / camera.zw);
  precise vec3 point = vec3(ray * depth_m, depth_m);
  return point;
}

const float kFarAway = 3.0e38;
shared int box_lo[3];
shared int box_hi[3];

// Integers have the order of the numbers.
int ordered(float x) {
  int bits = floatBitsToInt(x);
  return bits ^ ((bits >> 31) & 0x7FFFFFFF);
}
float number_of(int order) { return intBitsToFloat(order ^ ((order >> 31) & 0x7FFFFFFF)); }

// One invocation calls it before the first barrier.
void empty_box() {
  for (int axis = 0; axis < 3; ++axis) {
    box_lo[axis] = ordered(kFarAway);
    box_hi[axis] = ordered(-kFarAway);
  }
}
void extend_box(vec3 point) {
  for (int axis = 0; axis < 3; ++axis) {
    atomicMin(box_lo[axis], ordered(point[axis]));
    atomicMax(box_hi[axis], ordered(point[axis]));
  }
}
// After a barrier.
vec3 box_min() { return vec3(number_of(box_lo[0]), number_of(box_lo[1]), number_of(box_lo[2])); }
vec3 box_max() { return vec3(number_of(box_hi[0]), number_of(box_hi[1]), number_of(box_hi[2])); }
