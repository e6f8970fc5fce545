#include "thesis/opengl/gl_exact.hpp"

#include <algorithm>
#include <bit>

#include "thesis/opengl/gl_metric.hpp"

namespace berth {
namespace {

constexpr int kExactTilePx = 8;
/// Tiles of a node, along one side.
constexpr int kNodeSide = 4;
/// Nodes of one workgroup of obstacle_nodes.comp.glsl.
constexpr int kNodesOfGroup = 64;
/// Workgroups of a search, at most; each takes the next robot tiles until none is left.
constexpr int kMostGroups = 1024;

/// Bytes of the structs of obstacle_tile.glsl, robot_tile.glsl and closest_pair.glsl.
constexpr std::size_t kObstacleTileBytes = 12;
constexpr std::size_t kRobotTileBytes = 32;
constexpr std::size_t kPairBytes = 20;

Eigen::Vector2i tiles_of(const Camera& camera) {
  return {(camera.width_px + kExactTilePx - 1) / kExactTilePx,
          (camera.height_px + kExactTilePx - 1) / kExactTilePx};
}

int nodes_of(const Eigen::Vector2i& tiles) {
  return ((tiles.array() + kNodeSide - 1) / kNodeSide).prod();
}

/// A tile has no more links than pixels.
std::size_t most_robot_tiles(const Eigen::Vector2i& tiles, int link_count) {
  return static_cast<std::size_t>(tiles.prod()) * std::min(link_count, kExactTilePx * kExactTilePx);
}

}  // namespace

GlExact::GlExact()
    : obstacle_tiles_program_("obstacle_tiles.comp.glsl"),
      obstacle_nodes_program_("obstacle_nodes.comp.glsl"),
      robot_tiles_program_("robot_tiles.comp.glsl"),
      first_program_("exact_first.comp.glsl"),
      search_program_("exact_search.comp.glsl"),
      finish_program_("exact_finish.comp.glsl") {}

void GlExact::prepare(const Camera& camera, int link_count) {
  answers_.prepare(camera, link_count);
  finish_program_.bind("LinkAnswers", answers_.device());
  const Eigen::Vector2i tiles = tiles_of(camera);
  if (tiles != tiles_ || link_count != link_count_) {
    tiles_ = tiles;
    link_count_ = link_count;
    take_memory();
  }
  for (GlProgram* program : {&first_program_, &search_program_}) {
    program->set("intrinsics", gl_intrinsics(metric_of(camera)));
  }
  for (GlProgram* program : {&obstacle_nodes_program_, &first_program_, &search_program_}) {
    program->set("tiles", tiles_);
  }
  robot_tiles_program_.set("link_count", link_count);
}

void GlExact::take_memory() {
  const std::size_t robot_tiles = most_robot_tiles(tiles_, link_count_);
  obstacle_tiles_ = device_buffer(tiles_.prod() * kObstacleTileBytes);
  obstacle_nodes_ = device_buffer(nodes_of(tiles_) * kObstacleTileBytes);
  robot_tiles_ = device_buffer(robot_tiles * kRobotTileBytes);
  robot_tile_count_ = device_buffer(sizeof(std::uint32_t));
  link_pixels_ = device_buffer(link_count_ * sizeof(std::uint32_t));
  link_best_ = device_buffer(link_count_ * sizeof(std::uint32_t));
  tile_best_ = device_buffer(robot_tiles * kPairBytes);
  tile_pairs_ = device_buffer(robot_tiles * sizeof(std::uint32_t));

  obstacle_tiles_program_.bind("ObstacleTiles", obstacle_tiles_);
  robot_tiles_program_.bind("LinkPixels", link_pixels_);
  finish_program_.bind("LinkPixels", link_pixels_);
  for (GlProgram* program :
       {&robot_tiles_program_, &first_program_, &search_program_, &finish_program_}) {
    program->bind("RobotTiles", robot_tiles_);
    program->bind("RobotTileCount", robot_tile_count_);
  }
  for (GlProgram* program : {&obstacle_nodes_program_, &first_program_, &search_program_}) {
    program->bind("ObstacleTiles", obstacle_tiles_);
    program->bind("ObstacleNodes", obstacle_nodes_);
  }
  for (GlProgram* program : {&first_program_, &search_program_}) {
    program->bind("LinkBest", link_best_);
  }
  for (GlProgram* program : {&search_program_, &finish_program_}) {
    program->bind("TileBest", tile_best_);
    program->bind("TilePairs", tile_pairs_);
  }
}

void GlExact::find_tiles(const GlRobotImage& robot, const GlTexture& obstacle_depth_m) {
  robot_tile_count_.fill(0);
  link_pixels_.fill(0);
  obstacle_tiles_program_.read("obstacle_depth_m", obstacle_depth_m);
  obstacle_tiles_program_.dispatch(tiles_.x(), tiles_.y());
  obstacle_nodes_program_.dispatch((nodes_of(tiles_) + kNodesOfGroup - 1) / kNodesOfGroup);
  robot_tiles_program_.read("robot_depth_m", robot.depth_m);
  robot_tiles_program_.read("link_id", robot.link_id);
  robot_tiles_program_.dispatch(tiles_.x(), tiles_.y());
}

void GlExact::evaluate(const Camera& camera, const GlRobotImage& robot,
                       const GlTexture& obstacle_depth_m, int link_count,
                       const ImageDistanceSettings& settings, LinkDistances& out) {
  validate(settings);
  prepare(camera, link_count);
  find_tiles(robot, obstacle_depth_m);
  link_best_.fill(std::bit_cast<std::uint32_t>(gl_farthest_m2(settings.range_m)));
  const int groups = std::clamp(tiles_.prod(), 1, kMostGroups);
  first_program_.dispatch(groups);
  search_program_.read("robot_depth_m", robot.depth_m);
  search_program_.read("link_id", robot.link_id);
  search_program_.read("obstacle_depth_m", obstacle_depth_m);
  search_program_.dispatch(groups);
  finish_program_.read("robot_depth_m", robot.depth_m);
  answers_.set_region(finish_program_, settings.range_m);
  finish_program_.dispatch(std::max(link_count_, 1));
  answers_.finish(obstacle_depth_m, settings, true, out);
}

}  // namespace berth
