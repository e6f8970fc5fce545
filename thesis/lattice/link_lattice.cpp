#include "thesis/lattice/link_lattice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace berth {
namespace {

constexpr int kWordPixels = 64;

/// The bits of a word whose first pixel is `first` that lie in the columns [u_begin, u_end).
std::uint64_t bits_within(int first, int u_begin, int u_end) {
  const auto below = [](int bit) {
    return bit >= kWordPixels ? ~std::uint64_t{0} : (std::uint64_t{1} << bit) - 1;
  };
  return below(u_end - first) & ~below(std::max(u_begin - first, 0));
}

/// Calls visit(word index, bits) for the words of an image that hold pixels of the disc.
template <class Visit>
void visit_words(const PixelDisc& disc, int width, int height, int words_per_row, Visit visit) {
  const double radius_px = disc.radius_px;
  const int v_begin = std::max(disc.centre.v - disc.radius_px, 0);
  const int v_end = std::min(disc.centre.v + disc.radius_px + 1, height);
  for (int v = v_begin; v < v_end; ++v) {
    const double dv = v - disc.centre.v;
    const int du = static_cast<int>(std::sqrt(radius_px * radius_px - dv * dv));
    const int u_begin = std::max(disc.centre.u - du, 0);
    const int u_end = std::min(disc.centre.u + du + 1, width);
    for (int word = u_begin / kWordPixels; word * kWordPixels < u_end; ++word) {
      visit(v * words_per_row + word, bits_within(word * kWordPixels, u_begin, u_end));
    }
  }
}

}  // namespace

void PixelSet::reset(int width, int height) {
  width_ = width;
  height_ = height;
  words_per_row_ = (width + kWordPixels - 1) / kWordPixels;
  words_.assign(static_cast<std::size_t>(words_per_row_) * height, 0);
}

void PixelSet::insert(Pixel pixel) {
  words_[pixel.v * words_per_row_ + pixel.u / kWordPixels] |= std::uint64_t{1}
                                                              << pixel.u % kWordPixels;
}

void PixelSet::erase(Pixel pixel) {
  words_[pixel.v * words_per_row_ + pixel.u / kWordPixels] &=
      ~(std::uint64_t{1} << pixel.u % kWordPixels);
}

void PixelSet::erase(const PixelDisc& disc) {
  visit_words(disc, width_, height_, words_per_row_,
              [this](int word, std::uint64_t bits) { words_[word] &= ~bits; });
}

void PixelSet::insert_within(const PixelDisc& disc, const PixelSet& other) {
  visit_words(disc, width_, height_, words_per_row_,
              [&](int word, std::uint64_t bits) { words_[word] |= other.words_[word] & bits; });
}

Pixel PixelSet::first_from(int v_begin) const {
  const auto begin = words_.begin() + v_begin * words_per_row_;
  const auto found = std::find_if(begin, words_.end(), [](std::uint64_t w) { return w != 0; });
  if (found == words_.end()) return {};
  const int word = static_cast<int>(found - words_.begin());
  return {word % words_per_row_ * kWordPixels + std::countr_zero(*found), word / words_per_row_};
}

void take_lattice(int radius_px, int v_begin, PixelSet& candidates, std::vector<Pixel>& lattice) {
  lattice.clear();
  int v = v_begin;
  for (Pixel pixel = candidates.first_from(v); pixel.u >= 0; pixel = candidates.first_from(v)) {
    lattice.push_back(pixel);
    candidates.erase({pixel, radius_px});
    v = pixel.v;
  }
}

void LinkLattice::reset(int width, int height) {
  link_.reset(width, height);
  candidates_.reset(width, height);
}

void LinkLattice::begin(std::span<const Pixel> pixels) {
  pixels_ = pixels;
  for (const Pixel pixel : pixels) link_.insert(pixel);
}

const std::vector<Pixel>& LinkLattice::of_link(int radius_px) {
  for (const Pixel pixel : pixels_) candidates_.insert(pixel);
  take_lattice(radius_px, pixels_.empty() ? 0 : pixels_.front().v, candidates_, points_);
  return points_;
}

const std::vector<Pixel>& LinkLattice::within(const PixelDisc& disc, int radius_px) {
  candidates_.insert_within(disc, link_);
  take_lattice(radius_px, std::max(disc.centre.v - disc.radius_px, 0), candidates_, points_);
  return points_;
}

void LinkLattice::end() {
  for (const Pixel pixel : pixels_) link_.erase(pixel);
}

int finer_radius_px(int radius_px, int final_radius_px) {
  return std::max(radius_px / 2, final_radius_px);
}

}  // namespace berth
