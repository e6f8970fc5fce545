#pragma once

#include "berth/types/robot_image.hpp"
#include "thesis/lattice/link_lattice.hpp"
#include "thesis/lattice/link_pixels.hpp"
#include "thesis/opengl/gl_lattice_search.hpp"

namespace berth {

/// `lattice` with its distances on the GPU (Hirt 3.1.3, "CPU rasterization"): the CPU makes the
/// lattices of all links and sends their points, the GPU tries them and sends the closest pairs
/// back, for each radius. It finds the pairs of `lattice` in the region of the whole image.
class GlHybrid {
 public:
  /// Compiles the shaders.
  GlHybrid();

  /// Links 1 to link_count. The robot image, in this program's memory, and the obstacle image have
  /// the camera's size. All obstacle pixels are tried whatever settings.surveillance says. Takes
  /// memory where the image or the number of links has grown. Throws std::invalid_argument for bad
  /// settings.
  void evaluate(const Camera& camera, const RobotImage& robot, const GlTexture& obstacle_depth_m,
                int link_count, const ImageDistanceSettings& settings, LinkDistances& out);

 private:
  void prepare(const RobotImage& robot, int link_count);
  void list_links(const RobotImage& robot, int radius_px);
  void list_closest(const RobotImage& robot, int former_px, int radius_px);
  void list(int link, const std::vector<Pixel>& lattice, const RobotImage& robot);
  void search(PixelStep step);

  int link_count_ = 0;
  LinkPixels pixels_;
  LinkLattice lattice_;
  GlProgram search_points_program_;
  GlBuffer points_;
  std::uint32_t listed_ = 0;
  GlBuffer point_count_;
  GlBuffer link_pixels_;
  GlBuffer answers_back_;
  GlFence done_;
  GlLatticeSearch search_;
};

}  // namespace berth
