// A pair of pixels, and the closest one of a workgroup.

struct ClosestPair {
  float squared_m2;
  float robot_depth_m;
  float obstacle_depth_m;
  uint robot;  // column, and row << 16: packed pixels have the order of the image's rows
  uint obstacle;
};

const float kFarthest_m2 = 3.0e38;
ClosestPair no_pair() { return ClosestPair(kFarthest_m2, 0.0, 0.0, 0xFFFFFFFFu, 0xFFFFFFFFu); }

// Of pairs at the same distance the first in the order of the rows, the robot's pixel first; so that
// the answer does not depend on the order of invocations.
bool is_closer(ClosestPair a, ClosestPair b) {
  if (a.squared_m2 != b.squared_m2) return a.squared_m2 < b.squared_m2;
  if (a.robot != b.robot) return a.robot < b.robot;
  return a.obstacle < b.obstacle;
}

shared uint closest_m2;
shared uint closest_robot;
shared uint closest_obstacle;

// Whether this invocation's pair is the closest of all of the workgroup's; all invocations call it.
bool is_closest_of_workgroup(ClosestPair own) {
  if (gl_LocalInvocationIndex == 0) {
    closest_m2 = floatBitsToUint(kFarthest_m2);
    closest_robot = 0xFFFFFFFFu;
    closest_obstacle = 0xFFFFFFFFu;
  }
  barrier();
  uint m2 = floatBitsToUint(own.squared_m2);
  atomicMin(closest_m2, m2);
  barrier();
  bool is_least = m2 == closest_m2 && own.squared_m2 < kFarthest_m2;
  if (is_least) atomicMin(closest_robot, own.robot);
  barrier();
  is_least = is_least && own.robot == closest_robot;
  if (is_least) atomicMin(closest_obstacle, own.obstacle);
  barrier();
  bool is_closest = is_least && own.obstacle == closest_obstacle;
  barrier();
  return is_closest;
}

// After is_closest_of_workgroup(): whether any invocation had a pair.
bool workgroup_has_pair() { return closest_robot != 0xFFFFFFFFu; }
