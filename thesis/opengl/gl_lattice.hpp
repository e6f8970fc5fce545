#pragma once

#include <map>
#include <utility>

#include "thesis/opengl/gl_images.hpp"
#include "thesis/opengl/gl_lattice_search.hpp"

namespace berth {

/// The thesis's evaluator on the GPU alone (Hirt 3.1.3, "GPU rasterization"), **approximate** like
/// `lattice`: each tile of robot pixels gives one point for each of its links, the one nearest to
/// its centre (Manhattan distance); around each link's closest point smaller tiles do, until the
/// final size; last come all of the link's pixels within the final radius of the closest.
///
/// A request takes 4 dispatches and one for each halving of the tiles, 7 with the defaults, and
/// one for mean directions; the GPU is waited for once.
class GlLattice {
 public:
  /// Compiles the shaders that no tile size is in.
  GlLattice();

  /// Links 1 to link_count. The images have the camera's size. All obstacle pixels are tried
  /// whatever settings.surveillance says. Compiles shaders where tile sizes are new, and takes
  /// memory where the image or the number of links has grown. Throws std::invalid_argument for bad
  /// settings.
  void evaluate(const Camera& camera, const GlRobotImage& robot, const GlTexture& obstacle_depth_m,
                int link_count, const ImageDistanceSettings& settings, LinkDistances& out);

 private:
  GlProgram& points_program(int tile_px);
  GlProgram& search_tiles_program(int former_px, int tile_px);
  void list_points(const GlRobotImage& robot, int link_count, int tile_px);
  void search_tiles(const GlRobotImage& robot, int former_px, int tile_px, PixelStep step);

  /// By tile size, and by the former and the new one.
  std::map<int, GlProgram> points_programs_;
  std::map<std::pair<int, int>, GlProgram> search_tiles_programs_;
  GlProgram search_points_program_;
  GlProgram search_last_program_;
  GlBuffer points_;
  GlBuffer point_count_;
  GlBuffer link_pixels_;
  GlLatticeSearch search_;
};

}  // namespace berth
