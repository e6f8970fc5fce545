// Which obstacle pixels lie within the island radius of the robot's visible surface. Each such
// pixel begins as a piece of its own, and so does what the robot's growth dropped.
#include "filter_fates.glsl"
#include "filter_tile.glsl"
#include "filter_point.glsl"
#include "filter_pieces.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
layout(r32ui) uniform readonly uimage2D fate;
uniform float island_radius_m;
layout(std430) readonly buffer FilterTiles { FilterTile tiles[]; };
layout(std430) readonly buffer FilterFrame {
  uint reach_px;
  uint robot_tiles;
  uint robot_tile[];
};

shared uint open_pixels;
shared uint near_tiles;
shared uint near_tile[kTilePixels];
shared uint has_all_near;  // not 0: a tile whose points are all near all points here
shared vec4 robot_point_m[kTilePixels];
shared uint robot_points;

// Whether some, and all, points of two boxes are within the radius of each other; the operations of
// self_filter/boxes.cpp, so that rounding cannot part them from single distances.
bvec2 are_near(vec3 min_m, vec3 max_m, FilterTile robot) {
  precise vec3 above = robot.robot_min_m.xyz - max_m;
  precise vec3 below = min_m - robot.robot_max_m.xyz;
  precise vec3 least = max(vec3(0.0), max(above, below));
  precise vec3 most = max(abs(above), abs(below));
  precise float least2 = least.x * least.x + least.y * least.y + least.z * least.z;
  precise float most2 = most.x * most.x + most.y * most.y + most.z * most.z;
  precise float radius2 = island_radius_m * island_radius_m;
  return bvec2(least2 <= radius2, most2 <= radius2);
}

bool is_near(vec3 a, vec3 b) {
  precise vec3 d = b - a;
  precise float distance2 = d.x * d.x + d.y * d.y + d.z * d.z;
  precise float radius2 = island_radius_m * island_radius_m;
  return distance2 <= radius2;
}

// The points of a tile's pixels that show an evaluated link, into shared memory.
void gather_robot(uint tile) {
  if (gl_LocalInvocationIndex == 0) robot_points = 0u;
  barrier();
  uint columns = gl_NumWorkGroups.x;
  ivec2 pixel = kTilePx * ivec2(tile % columns, tile / columns) + ivec2(gl_LocalInvocationID.xy);
  if (all(lessThan(pixel, textureSize(link_id, 0))) && is_evaluated(texelFetch(link_id, pixel, 0).x)) {
    vec3 point = point_m(pixel, texelFetch(robot_depth_m, pixel, 0).x);
    robot_point_m[atomicAdd(robot_points, 1u)] = vec4(point, 0.0);
  }
  barrier();
}

// Sorts the robot's tiles from this one on, one an invocation.
void find_near_tiles(uint first, vec3 min_m, vec3 max_m) {
  if (gl_LocalInvocationIndex == 0) {
    near_tiles = 0u;
    has_all_near = 0u;
  }
  barrier();
  uint i = first + gl_LocalInvocationIndex;
  if (i < robot_tiles) {
    bvec2 near = are_near(min_m, max_m, tiles[robot_tile[i]]);
    if (near.y) atomicOr(has_all_near, 1u);
    if (near.x) near_tile[atomicAdd(near_tiles, 1u)] = robot_tile[i];
  }
  barrier();
}

bool is_near_any(vec3 point) {
  for (uint i = 0u; i < robot_points; ++i) {
    if (is_near(point, robot_point_m[i].xyz)) return true;
  }
  return false;
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(fate);
  if (gl_LocalInvocationIndex == 0) {
    open_pixels = 0u;
    empty_box();
  }
  barrier();
  bool is_inside = all(lessThan(pixel, size));
  bool is_open = is_inside && imageLoad(fate, pixel).x == kObstacle;
  vec3 point = is_open ? point_m(pixel, texelFetch(sensor_depth_m, pixel, 0).x) : vec3(0.0);
  if (is_open) {
    extend_box(point);
    atomicAdd(open_pixels, 1u);
  }
  barrier();
  bool was_open = is_open;
  vec3 min_m = box_min();
  vec3 max_m = box_max();
  for (uint first = 0u; first < robot_tiles && open_pixels > 0u; first += kTilePixels) {
    find_near_tiles(first, min_m, max_m);
    if (has_all_near != 0u) is_open = false;
    if (has_all_near != 0u) break;
    for (uint i = 0u; i < near_tiles && open_pixels > 0u; ++i) {
      gather_robot(near_tile[i]);
      if (is_open && are_near(point, point, tiles[near_tile[i]]).x && is_near_any(point)) {
        is_open = false;
        atomicAdd(open_pixels, 0xFFFFFFFFu);
      }
      barrier();
    }
    barrier();
  }
  if (!is_inside) return;
  uint number = number_of_pixel(pixel, size);
  bool begins = was_open ? !is_open : is_grown(imageLoad(fate, pixel).x);
  pieces[number] = Piece(begins ? number : kNoPiece, 0u, 0u, 0u);
}
