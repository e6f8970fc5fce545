// Robot pixels of one link as bits, so that drawing a circle and asking for the next pixel outside
// of all circles take words, not pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "berth/types/image.hpp"

namespace berth {

/// The pixels at most radius_px away from the centre.
struct PixelDisc {
  Pixel centre;
  int radius_px = 0;
};

/// A set of pixels of an image.
class PixelSet {
 public:
  /// Makes it an empty set of an image's pixels; keeps its memory where that is enough.
  void reset(int width, int height);
  void insert(Pixel pixel);
  void erase(Pixel pixel);
  void erase(const PixelDisc& disc);
  /// Adds those pixels of the other set, of the same image, that lie within the disc.
  void insert_within(const PixelDisc& disc, const PixelSet& other);
  /// The first pixel by rows in the rows from v_begin on; (-1, -1) if there is none.
  Pixel first_from(int v_begin) const;

 private:
  int width_ = 0;
  int height_ = 0;
  int words_per_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// A link's lattice (Hirt 2.2.4, 3.1.2): by rows from v_begin on, each pixel that lies in no circle
/// of this radius around one taken before. Empties `candidates`, which has no pixel above v_begin.
void take_lattice(int radius_px, int v_begin, PixelSet& candidates, std::vector<Pixel>& lattice);

/// The lattices of one link after another, with the memory for them.
class LinkLattice {
 public:
  /// For links of images of this size.
  void reset(int width, int height);
  /// Begins a link; its pixels by rows, which stay where they are until end().
  void begin(std::span<const Pixel> pixels);
  /// Points whose circles of this radius hold all of the link, until the next call here or below.
  const std::vector<Pixel>& of_link(int radius_px);
  /// The same for the link's pixels within a disc.
  const std::vector<Pixel>& within(const PixelDisc& disc, int radius_px);
  void end();

 private:
  /// Empty between two links.
  PixelSet link_;
  PixelSet candidates_;
  std::span<const Pixel> pixels_;
  std::vector<Pixel> points_;
};

/// The next, finer radius: half, and at least the final one.
int finer_radius_px(int radius_px, int final_radius_px);

}  // namespace berth
