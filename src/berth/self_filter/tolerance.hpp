#pragma once

#include "berth/self_filter/settings.hpp"

namespace berth {

/// A reading belongs to a surface of depth z unless it is nearer than z by more than
/// constant_m + per_m2 z^2.
struct Tolerance {
  float constant_m;
  float per_m2;

  /// The least reading that belongs to a surface of this depth; pixels-inl.hpp has it in vectors,
  /// with the same operations.
  float least_reading_m(float z_m) const { return z_m - (constant_m + per_m2 * z_m * z_m); }

  /// The greatest reading that may be on a surface of this depth; a deeper one lies behind it.
  float greatest_reading_m(float z_m) const { return z_m + (constant_m + per_m2 * z_m * z_m); }
};

inline Tolerance tolerance_of(const SelfFilterSettings& settings) {
  return {static_cast<float>(settings.tolerance_m), static_cast<float>(settings.tolerance_per_m2)};
}

}  // namespace berth
