#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "berth/self_filter/self_filter.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/obstacle_image.hpp"
#include "thesis/opengl/gl_buffer.hpp"
#include "thesis/opengl/gl_images.hpp"
#include "thesis/opengl/gl_program.hpp"

namespace berth {

/// self_filter() on the GPU: the rules for pixels and padding by the same operations,
/// those for pieces by the processor (judge_pieces()), so that from the same robot image it gives
/// the same fates.
class GlSelfFilter {
 public:
  /// Compiles the shaders.
  GlSelfFilter();

  /// All images have the camera's size; `sensor_depth_m` and F hold 0 where there is nothing. Takes
  /// memory where the size or link_padding_m is new. Throws std::invalid_argument for bad settings,
  /// and if settings.robot_region_scale asks for a region.
  void filter(const Camera& camera, const GlTexture& sensor_depth_m, const GlRobotImage& robot,
              const SelfFilterSettings& settings, const GlObstacleImage& out);
  /// The same with the robot-shaped region: `region_id` are the link IDs of robot_region(), drawn
  /// at the same pose. Throws std::invalid_argument if the settings ask for no region.
  void filter(const Camera& camera, const GlTexture& sensor_depth_m, const GlRobotImage& robot,
              const GlTexture& region_id, const SelfFilterSettings& settings,
              const GlObstacleImage& out);

  /// Pixels of each PixelFate of the last image, once the GPU has made it.
  std::array<std::int64_t, kPixelFateCount> count();

 private:
  /// What all passes of one image are given; no region is null.
  struct Images {
    const GlTexture& sensor_depth_m;
    const GlRobotImage& robot;
    const GlTexture* region_id;
    const GlObstacleImage& out;
  };

  void filter(const Camera& camera, const Images& images, const SelfFilterSettings& settings);
  void prepare(const Camera& camera);
  void take_memory();
  void set_paddings(const SelfFilterSettings& settings);
  void look_at_pixels(const Camera& camera, const Images& images,
                      const SelfFilterSettings& settings);
  void pad(const Images& images);
  void judge_pieces(const Camera& camera, const Images& images, const SelfFilterSettings& settings);
  void finish(const Images& images);
  void dispatch(GlProgram& program) { program.dispatch(tiles_.x(), tiles_.y()); }

  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  Eigen::Vector2i tiles_ = Eigen::Vector2i::Zero();
  GlProgram pixels_program_;
  GlProgram grow_program_;
  GlProgram finish_program_;
  GlBuffer filter_tiles_;
  GlBuffer discs_;
  GlBuffer frame_;
  std::vector<double> link_padding_m_;
  GlBuffer link_paddings_;
  GlBuffer counts_;
  GlBuffer counts_back_;
  GlFence counted_;
  /// What the processor judges.
  DepthImage sensor_depth_m_;
  RobotImage robot_;
  ObstacleImage obstacles_;
  SelfFilterWorkspace workspace_;
  std::optional<GlUpload> upload_;
};

}  // namespace berth
