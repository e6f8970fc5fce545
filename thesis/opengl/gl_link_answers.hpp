// What the GPU finds for each link, and its way back.
#pragma once

#include <cstdint>

#include "berth/types/camera.hpp"
#include "thesis/link_distance.hpp"
#include "thesis/opengl/gl_buffer.hpp"
#include "thesis/opengl/gl_program.hpp"
#include "thesis/settings.hpp"

namespace berth {

/// LinkAnswer of link_answer.glsl.
struct GlLinkAnswer {
  float squared_m2;
  float robot_depth_m;
  float obstacle_depth_m;
  std::uint32_t robot;
  std::uint32_t obstacle;
  std::uint32_t robot_pixels;
  std::uint32_t pairs_lo;
  std::uint32_t pairs_hi;
  std::int32_t u_begin;
  std::int32_t v_begin;
  std::int32_t u_end;
  std::int32_t v_end;
  float max_depth_m;
};

inline bool has_pair(const GlLinkAnswer& answer) { return answer.robot_depth_m > 0; }

/// As pack() and unpack() of pixels.glsl.
inline std::uint32_t packed_pixel(Pixel pixel) {
  return static_cast<std::uint32_t>(pixel.u) | static_cast<std::uint32_t>(pixel.v) << 16;
}
inline Pixel unpacked_pixel(std::uint32_t packed) {
  return {static_cast<int>(packed & 0xFFFF), static_cast<int>(packed >> 16)};
}

/// The last step of every evaluator on the GPU: an evaluator writes device(), then comes finish().
class GlLinkAnswers {
 public:
  GlLinkAnswers();

  /// To be called before an evaluator writes; takes memory where the number of links has grown.
  void prepare(const Camera& camera, int link_count);
  /// `LinkAnswers` of the shaders, until the next prepare().
  const GlBuffer& device() const { return answers_; }
  /// Sets `pinhole` and `range_m` of region_of_surveillance.glsl.
  void set_region(GlProgram& program, double range_m) const;

  /// Sums the mean directions if the settings ask for them, waits for the GPU, and writes the
  /// links; distances and points are computed here from the pixels that the GPU found, by the
  /// metric of the thesis. `certifies`: whether no pair can be closer than those.
  void finish(const GlTexture& obstacle_depth_m, const ImageDistanceSettings& settings,
              bool certifies, LinkDistances& out);

 private:
  void read_link(int link, const ImageDistanceSettings& settings, bool certifies,
                 LinkDistance& out);
  void read_direction(int link, LinkDistance& out);

  Camera camera_;
  int link_count_ = 0;
  GlProgram mean_direction_;
  GlBuffer answers_;
  GlBuffer answers_back_;
  GlBuffer sums_;
  GlBuffer sums_back_;
  GlFence done_;
};

}  // namespace berth
