#pragma once

#include <cstddef>
#include <cstdint>

namespace berth {

/// LatticePoint of lattice_point.glsl.
struct GlLatticePoint {
  std::uint32_t link;
  std::uint32_t pixel;
  float depth_m;
  std::uint32_t unused;
};

/// A list for any lattices of an image: no pixel is in it twice.
inline std::size_t lattice_point_bytes(int width, int height) {
  return static_cast<std::size_t>(width) * height * sizeof(GlLatticePoint);
}

}  // namespace berth
