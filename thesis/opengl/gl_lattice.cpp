#include "thesis/opengl/gl_lattice.hpp"

#include <algorithm>
#include <string>

#include "thesis/lattice/link_lattice.hpp"
#include "thesis/opengl/gl_lattice_point.hpp"

namespace berth {
namespace {

/// lattice_search_last.comp.glsl takes no larger radius; no image is larger.
constexpr int kMostRadiusPx = 65535;

int tiles_along(int size_px, int tile_px) { return (size_px + tile_px - 1) / tile_px; }

}  // namespace

GlLattice::GlLattice()
    : search_points_program_("lattice_search_points.comp.glsl"),
      search_last_program_("lattice_search_last.comp.glsl"),
      point_count_(sizeof(std::uint32_t), GlMemory::device) {
  search_points_program_.bind("LatticePointCount", point_count_);
}

GlProgram& GlLattice::points_program(int tile_px) {
  const auto found = points_programs_.find(tile_px);
  if (found != points_programs_.end()) return found->second;
  const ShaderConstants constants = {{"TILE_PX", std::to_string(tile_px)}};
  return points_programs_.try_emplace(tile_px, "lattice_points.comp.glsl", constants).first->second;
}

GlProgram& GlLattice::search_tiles_program(int former_px, int tile_px) {
  const std::pair sizes(former_px, tile_px);
  const auto found = search_tiles_programs_.find(sizes);
  if (found != search_tiles_programs_.end()) return found->second;
  const ShaderConstants constants = {{"FORMER_PX", std::to_string(former_px)},
                                     {"TILE_PX", std::to_string(tile_px)}};
  return search_tiles_programs_.try_emplace(sizes, "lattice_search_tiles.comp.glsl", constants)
      .first->second;
}

void GlLattice::list_points(const GlRobotImage& robot, int link_count, int tile_px) {
  const int width = robot.link_id.width();
  const int height = robot.link_id.height();
  take_at_least(lattice_point_bytes(width, height), points_);
  search_points_program_.bind("LatticePoints", points_);
  take_at_least(link_count * sizeof(std::uint32_t), link_pixels_);
  point_count_.fill(0);
  link_pixels_.fill(0);
  GlProgram& program = points_program(tile_px);
  program.set("link_count", link_count);
  program.read("robot_depth_m", robot.depth_m);
  program.read("link_id", robot.link_id);
  program.bind("LatticePoints", points_);
  program.bind("LatticePointCount", point_count_);
  program.bind("LinkPixels", link_pixels_);
  program.dispatch(tiles_along(width, tile_px), tiles_along(height, tile_px));
}

void GlLattice::search_tiles(const GlRobotImage& robot, int former_px, int tile_px,
                             PixelStep step) {
  GlProgram& program = search_tiles_program(former_px, tile_px);
  program.read("robot_depth_m", robot.depth_m);
  program.read("link_id", robot.link_id);
  search_.run(program, step);
}

void GlLattice::evaluate(const Camera& camera, const GlRobotImage& robot,
                         const GlTexture& obstacle_depth_m, int link_count,
                         const ImageDistanceSettings& settings, LinkDistances& out) {
  validate(settings);
  const LatticeSettings& lattice = settings.lattice;
  const PixelStep skipping{lattice.step_x, lattice.step_y};
  int tile_px = lattice.tile_px;
  list_points(robot, link_count, tile_px);
  search_.begin(camera, link_count, obstacle_depth_m, settings, link_pixels_);
  search_.run(search_points_program_, skipping);
  while (tile_px > lattice.final_grid_radius_px) {
    const int former_px = tile_px;
    tile_px = finer_radius_px(tile_px, lattice.final_grid_radius_px);
    search_tiles(robot, former_px, tile_px, skipping);
  }
  search_last_program_.set("radius_px", std::min(lattice.final_grid_radius_px, kMostRadiusPx));
  search_last_program_.read("robot_depth_m", robot.depth_m);
  search_last_program_.read("link_id", robot.link_id);
  search_.run(search_last_program_, {1, 1});
  search_.finish(out);
}

}  // namespace berth
