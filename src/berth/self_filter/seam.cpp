#include "berth/self_filter/seam.hpp"

#include <algorithm>

#include "berth/self_filter/joined.hpp"

namespace berth {
namespace {

enum State : std::uint8_t { kUnknown, kWalked, kHangs };

bool is_grown(PixelFate fate) { return fate == PixelFate::padding || fate == PixelFate::dilation; }

}  // namespace

Seam::~Seam() {
  for (const Pixel& p : known_) state_(p.u, p.v) = kUnknown;
  known_.clear();
}

bool Seam::is_own(int u, int v) const {
  return fate_(u, v) == PixelFate::robot &&
         depth_m_(u, v) <= tolerance_.greatest_reading_m(robot_.depth_m(u, v));
}

/// Whether call(u, v) holds for a neighbour that is no step away; asks no more of them then.
template <class Call>
bool Seam::any_joined(Pixel p, const Call& call) const {
  const float depth_m = depth_m_(p.u, p.v);
  for (int v = std::max(0, p.v - 1); v <= std::min(depth_m_.height - 1, p.v + 1); ++v) {
    for (int u = std::max(0, p.u - 1); u <= std::min(depth_m_.width - 1, p.u + 1); ++u) {
      if (is_joined(depth_m_(u, v), depth_m, jump_m_) && call(u, v)) return true;
    }
  }
  return false;
}

bool Seam::leads_to(Pixel p) {
  return any_joined(p, [&](int u, int v) {
    if (is_own(u, v) || state_(u, v) == kHangs) return true;
    return is_grown(fate_(u, v)) && state_(u, v) == kUnknown && walk_from({u, v});
  });
}

/// Ends at the first pixel that is known to hang: what was walked hangs on it. Else all that can be
/// reached was walked, and need not be again.
bool Seam::walk_from(Pixel start) {
  const std::size_t first = known_.size();
  known_.push_back(start);
  state_(start.u, start.v) = kWalked;
  bool hangs = false;
  for (std::size_t next = first; next < known_.size() && !hangs; ++next) {
    hangs = any_joined(known_[next], [&](int u, int v) {
      if (is_own(u, v) || state_(u, v) == kHangs) return true;
      if (is_grown(fate_(u, v)) && state_(u, v) == kUnknown) {
        state_(u, v) = kWalked;
        known_.push_back({u, v});
      }
      return false;
    });
  }
  if (!hangs) return false;
  for (std::size_t i = first; i < known_.size(); ++i) state_(known_[i].u, known_[i].v) = kHangs;
  return true;
}

}  // namespace berth
