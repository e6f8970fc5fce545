#pragma once

#include <memory>

#include "thesis/evaluate.hpp"

namespace berth {

/// One way to find the closest pairs of two images, wherever it runs: chosen once, asked often. It
/// carries nothing from one answer to the next.
class ImageMethod {
 public:
  virtual ~ImageMethod() = default;

  /// As evaluate().
  virtual void evaluate(const ImageRequest& request, LinkDistances& out) = 0;
};

/// Throws std::invalid_argument unless the method compares images on the processor.
std::unique_ptr<ImageMethod> make_image_method(Method method);

}  // namespace berth
