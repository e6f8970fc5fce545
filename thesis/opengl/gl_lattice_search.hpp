#pragma once

#include "berth/types/camera.hpp"
#include "thesis/opengl/gl_link_answers.hpp"
#include "thesis/opengl/gl_program.hpp"
#include "thesis/opengl/gl_texture.hpp"
#include "thesis/search_pattern.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// A request's searches on the GPU, each around the pairs that the one before found. A search
/// tries its robot pixels against every step-th obstacle pixel of the whole image: a workgroup for
/// each link and slice of the image.
class GlLatticeSearch {
 public:
  GlLatticeSearch();

  /// Begins a request. `link_pixels` holds the number of pixels of each link, as an unsigned of 32
  /// bits, by the time of the first run(); links without any are passed over. Takes memory where
  /// the image is larger or has more links than before.
  void begin(const Camera& camera, int link_count, const GlTexture& obstacle_depth_m,
             const ImageDistanceSettings& settings, const GlBuffer& link_pixels);

  /// One search; the program is a shader that includes lattice_search.glsl, and the inputs that are
  /// its own are set.
  void run(GlProgram& program, PixelStep step);

  /// The closest pairs so far as `LinkAnswers`.
  const GlBuffer& answers();

  /// The answer from the pairs so far; it certifies nothing.
  void finish(LinkDistances& out);

 private:
  const GlTexture* obstacle_depth_m_ = nullptr;
  const GlBuffer* link_pixels_ = nullptr;
  ImageDistanceSettings settings_;
  Eigen::Vector4f intrinsics_ = Eigen::Vector4f::Zero();
  int link_count_ = 0;
  /// Of the last run.
  unsigned slices_ = 0;
  GlProgram finish_program_;
  GlBuffer link_pairs_;
  GlBuffer former_closest_;
  GlBuffer slice_closest_;
  GlLinkAnswers answers_;
};

}  // namespace berth
