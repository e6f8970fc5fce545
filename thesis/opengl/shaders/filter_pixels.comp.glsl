// The rules of the self filter that look at single pixels, and the robot's outline.
#include "filter_fates.glsl"
#include "filter_tile.glsl"
#include "filter_disc.glsl"
#include "pixels.glsl"
#include "tolerance.glsl"

layout(local_size_x = 16, local_size_y = 16) in;

uniform sampler2D sensor_depth_m;
uniform sampler2D robot_depth_m;
uniform usampler2D link_id;
layout(r32ui) uniform writeonly uimage2D fate;
uniform float deeper;  // an outline's neighbour is deeper by more than this factor
uniform double padding_m;
uniform double environment_padding_m;
uniform float padding_depth_m;
uniform int link_paddings;
layout(std430) readonly buffer LinkPadding { double link_padding_m[]; };  // links 1 to link_paddings
layout(std430) writeonly buffer FilterTiles { FilterTile tiles[]; };
layout(std430) writeonly buffer Discs { Disc discs[]; };  // kTilePixels places for each tile
layout(std430) buffer FilterFrame {
  uint reach_px;
};

shared uint tile_discs;
shared uint tile_reach;

uint fate_of(ivec2 pixel, uint link, float robot_m) {
  float reading_m = texelFetch(sensor_depth_m, pixel, 0).x;
  if (!(reading_m > 0.0)) return kNoReading;
  if (link != kNoLink && reading_m >= least_reading_m(robot_m)) {
    return link == kEnvironmentLink ? kEnvironment : kRobot;
  }
  return kObstacle;
}

// Whether link or environment does not go on at a neighbour, which is the pixel itself at the image's
// border; as in self_filter/outline.hpp.
bool ends_at(ivec2 neighbour, uint link, float robot_m) {
  ivec2 inside = clamp(neighbour, ivec2(0), textureSize(link_id, 0) - 1);
  uint next = texelFetch(link_id, inside, 0).x;
  float next_m = texelFetch(robot_depth_m, inside, 0).x;
  if (link == kEnvironmentLink) return next == kNoLink || robot_m < least_reading_m(next_m);
  precise float most_m = robot_m * deeper;
  return !is_evaluated(next) || next_m > most_m;
}

bool is_outline(ivec2 pixel, uint link, float robot_m) {
  return ends_at(pixel - ivec2(1, 0), link, robot_m) ||
         ends_at(pixel + ivec2(1, 0), link, robot_m) ||
         ends_at(pixel - ivec2(0, 1), link, robot_m) ||
         ends_at(pixel + ivec2(0, 1), link, robot_m);
}

double padding_of(uint link) {
  if (link == kEnvironmentLink) return environment_padding_m;
  return int(link) <= link_paddings ? link_padding_m[link - 1u] : padding_m;
}

void add_disc(ivec2 pixel, uint link, float robot_m, uint tile) {
  ivec2 size = textureSize(link_id, 0);
  precise float most_m = robot_m + padding_depth_m;
  Disc disc = Disc(-1.0LF, 1.0LF, least_reading_m(robot_m), most_m, pack(pixel));
  dvec2 radius_px = disc_radius_px(padding_of(link), robot_m, size);
  if (radius_px.x > 0.0LF) atomicMax(tile_reach, reach_of(radius_px));
  discs[tile * kTilePixels + atomicAdd(tile_discs, 1u)] = with_radius(disc, radius_px);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (gl_LocalInvocationIndex == 0) {
    tile_discs = 0u;
    tile_reach = 0u;
  }
  barrier();
  if (all(lessThan(pixel, textureSize(link_id, 0)))) {
    uint link = texelFetch(link_id, pixel, 0).x;
    float robot_m = texelFetch(robot_depth_m, pixel, 0).x;
    imageStore(fate, pixel, uvec4(fate_of(pixel, link, robot_m)));
    if (link != kNoLink && is_outline(pixel, link, robot_m)) add_disc(pixel, link, robot_m, tile);
  }
  barrier();
  if (gl_LocalInvocationIndex != 0) return;
  tiles[tile] = FilterTile(tile_discs, float(tile_reach));
  atomicMax(reach_px, tile_reach);
}
