#pragma once

#include <memory>

#include "berth/pipeline/frame.hpp"

namespace berth {

struct GlFrameImages;

/// A Frame whose images are on the GPU, in the context that was current when it was made.
struct GlFrame : Exposure {
  explicit GlFrame(const Camera& camera);
  ~GlFrame();
  GlFrame(GlFrame&&) noexcept;
  GlFrame& operator=(GlFrame&&) noexcept;

  /// Never null but in a frame that was moved from.
  std::unique_ptr<GlFrameImages> images;
};

/// All of it in this program's memory, whose images `out` reuses.
void read_back(const GlFrame& frame, Frame& out);

}  // namespace berth
