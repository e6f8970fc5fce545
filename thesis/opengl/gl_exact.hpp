#pragma once

#include "berth/types/camera.hpp"
#include "thesis/opengl/gl_images.hpp"
#include "thesis/opengl/gl_link_answers.hpp"
#include "thesis/opengl/gl_program.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// brute_force's answer on the GPU: each tile of robot pixels prunes the tiles of obstacle pixels
/// by the bounds of `exact`, and tries the pixels of the others. Its distances differ from
/// brute_force's by less than 2e-5 m, since a GPU may round bounds in its own way.
class GlExact {
 public:
  /// Compiles the shaders.
  GlExact();

  /// Links 1 to link_count. The images have the camera's size. Takes memory where that or the
  /// number of links has changed. Neither tolerance_m nor deadline_us is used: the answer is
  /// complete. Throws std::invalid_argument for bad settings.
  void evaluate(const Camera& camera, const GlRobotImage& robot, const GlTexture& obstacle_depth_m,
                int link_count, const ImageDistanceSettings& settings, LinkDistances& out);

 private:
  void prepare(const Camera& camera, int link_count);
  void take_memory();
  void find_tiles(const GlRobotImage& robot, const GlTexture& obstacle_depth_m);

  Eigen::Vector2i tiles_ = Eigen::Vector2i::Zero();
  int link_count_ = 0;
  GlProgram obstacle_tiles_program_;
  GlProgram obstacle_nodes_program_;
  GlProgram robot_tiles_program_;
  GlProgram first_program_;
  GlProgram search_program_;
  GlProgram finish_program_;
  GlBuffer obstacle_tiles_;
  GlBuffer obstacle_nodes_;
  GlBuffer robot_tiles_;
  GlBuffer robot_tile_count_;
  GlBuffer link_pixels_;
  GlBuffer link_best_;
  GlBuffer tile_best_;
  GlBuffer tile_pairs_;
  GlLinkAnswers answers_;
};

}  // namespace berth
