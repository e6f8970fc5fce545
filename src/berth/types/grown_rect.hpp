// Inside berth only.
#pragma once

#include "berth/types/image.hpp"

namespace berth {

/// With this number of pixels more on each side; may reach beyond the image.
inline PixelRect grown_by(const PixelRect& rect, int reach_px) {
  return {rect.u_begin - reach_px, rect.v_begin - reach_px, rect.u_end + reach_px,
          rect.v_end + reach_px};
}

}  // namespace berth
