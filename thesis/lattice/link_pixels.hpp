#pragma once

#include <span>
#include <vector>

#include "berth/types/image.hpp"
#include "berth/types/robot_image.hpp"

namespace berth {

/// The pixels of each link in a robot image, by rows.
class LinkPixels {
 public:
  /// Sorts the pixels of links 1 to link_count; any other id but kEnvironmentLink is a programming
  /// error. Keeps its memory where that is enough.
  void sort(const RobotImage& robot, int link_count);
  /// Those of the link with the id `link` + 1.
  std::span<const Pixel> of(int link) const {
    return {pixels_.data() + first_[link], pixels_.data() + first_[link + 1]};
  }

 private:
  std::vector<Pixel> pixels_;
  /// Where the pixels of each link begin, and the end of the last.
  std::vector<int> first_;
};

}  // namespace berth
