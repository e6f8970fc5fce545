// Inside record/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "berth/pipeline/mounted_camera.hpp"
#include "berth/record/tape.hpp"

namespace berth {

using KeptImage = std::shared_ptr<const RecordedImage>;

/// Images that nobody asks are kept up to so many of each camera.
inline constexpr std::size_t kMostKept = 64;

/// The images of one camera that a request may still be about, and those before them that their
/// means are taken over.
class KeptImages {
 public:
  explicit KeptImages(const MountedCamera& view)
      : memory_(view.settings().sensor.averages() ? view.settings().sensor.average_frames : 1) {}

  void put(KeptImage image) {
    images_.push_back(std::move(image));
    if (images_.size() > kMostKept) drop_first(1);
  }
  /// What comes does not go on from these.
  void lose() {
    is_from_first_ &= images_.empty();
    images_.clear();
  }
  /// One is missing.
  void lose_one() {
    images_.clear();
    is_from_first_ = false;
  }
  bool holds(std::uint64_t number) const { return find(number) != images_.size(); }
  /// Whether an observer that sees these alone makes the same frame.
  bool is_whole(std::uint64_t number) const { return holds(number) && needed_for(number).is_whole; }
  /// Nothing before this frame will be asked any more.
  void drop_before(std::uint64_t number) {
    if (holds(number)) drop_first(needed_for(number).first);
  }
  const std::vector<KeptImage>& images() const { return images_; }

 private:
  std::size_t find(std::uint64_t number) const {
    std::size_t i = images_.size();
    while (i > 0 && images_[i - 1]->exposure.number != number) --i;
    return i == 0 ? images_.size() : i - 1;
  }
  /// From which image on an observer remembers something in this one; whether they are all here.
  struct Needed {
    std::size_t first;
    bool is_whole;
  };
  Needed needed_for(std::uint64_t number) const {
    int left = memory_;
    for (std::size_t i = find(number);; --i) {
      // One without its joints is not remembered.
      if (images_[i]->exposure.time.status == TimeStatus::ok && --left == 0) return {i, true};
      if (i == 0) return {0, is_from_first_};
    }
  }
  void drop_first(std::size_t count) {
    if (count == 0) return;
    images_.erase(images_.begin(), images_.begin() + static_cast<std::ptrdiff_t>(count));
    is_from_first_ = false;
  }

  int memory_;
  std::vector<KeptImage> images_;
  bool is_from_first_ = true;
};

}  // namespace berth
