#include "berth/space/far_reaching.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "berth/space/least_of_rows.hpp"

namespace berth {
namespace {

/// The k of the greatest squares of 2^k pixels that fit into `pixels`, at least one.
int level_of(int pixels) { return std::bit_width(static_cast<unsigned>(pixels)) - 1; }

/// Makes `value` hold in all pixels of `rect`, by squares of the greatest size that fits.
void hold_in(const PixelRect& rect, float value, std::vector<DepthImage>& levels) {
  const int level = level_of(std::min(rect.u_end - rect.u_begin, rect.v_end - rect.v_begin));
  const int side = 1 << level;
  DepthImage& squares = levels[level];
  for (int v = rect.v_begin;; v = std::min(v + side, rect.v_end - side)) {
    for (int u = rect.u_begin;; u = std::min(u + side, rect.u_end - side)) {
      squares(u, v) = std::min(squares(u, v), value);
      if (u + side == rect.u_end) break;
    }
    if (v + side == rect.v_end) break;
  }
}

/// The same for many pixels side by side, from the one at (u, v) on: each one's value holds in all
/// that are no more than `reach` from it, which lie in the image.
void hold_around(const float* values, int count, int u, int v, int reach,
                 std::vector<DepthImage>& levels) {
  const int level = level_of(2 * reach + 1);
  const int last = reach + 1 - (1 << level);
  for (const int y : {v - reach, v + last}) {
    for (const int x : {u - reach, u + last}) take_least(values, count, levels[level].row(y) + x);
  }
}

/// Takes a row's pixels into the squares: those with one reach at once, but at the image's ends.
void hold_row(const std::vector<float>& left_m, const std::vector<int>& far_reach,
              const PixelRect& pixels, int v, std::vector<DepthImage>& levels) {
  const int width = levels[0].width();
  const int height = levels[0].height();
  for (int u = pixels.u_begin; u < pixels.u_end;) {
    const int reach = far_reach[u];
    int end = u + 1;
    while (end < pixels.u_end && far_reach[end] == reach) ++end;
    const bool fits = v >= reach && v + reach < height && 2 * reach < width;
    const int inner = fits ? std::clamp(reach, u, end) : end;
    const int outer = fits ? std::clamp(width - reach, inner, end) : end;
    if (reach > 0 && outer > inner) {
      hold_around(&left_m[inner], outer - inner, inner, v, reach, levels);
    }
    for (int at = u; reach > 0 && at < end; ++at) {
      if (at == inner) at = outer;
      if (at == end) break;
      hold_in(clip({at - reach, v - reach, at + reach + 1, v + reach + 1}, width, height),
              left_m[at], levels);
    }
    u = end;
  }
}

/// Each square's value holds in its four quarters; the squares lie in `touched`.
void hold_in_quarters(const DepthImage& squares, int half, const PixelRect& touched,
                      DepthImage& quarters) {
  const int columns = touched.u_end - touched.u_begin - 2 * half + 1;
  if (columns <= 0) return;
  for (int v = touched.v_begin; v + 2 * half <= touched.v_end; ++v) {
    const float* const from = squares.row(v) + touched.u_begin;
    for (const int y : {v, v + half}) {
      for (const int x : {0, half}) {
        take_least(from, columns, quarters.row(y) + touched.u_begin + x);
      }
    }
  }
}

/// Holds all pixels that workspace.reach says are beyond the rings.
PixelRect far_pixels(const AgingWorkspace& workspace) {
  const int width = workspace.reach.width();
  const int height = workspace.reach.height();
  PixelRect far{width, height, 0, 0};
  for (int v = 0; v < height; ++v) {
    const std::uint8_t* const row = workspace.reach.row(v);
    const auto is_far = [](std::uint8_t reach) { return reach > kMostRing; };
    const std::uint8_t* const first = std::find_if(row, row + width, is_far);
    if (first == row + width) continue;
    int last = width;
    while (!is_far(row[last - 1])) --last;
    far = {std::min(far.u_begin, static_cast<int>(first - row)), std::min(far.v_begin, v),
           std::max(far.u_end, last), v + 1};
  }
  return far;
}

/// The greatest of their reaches.
int greatest_reach(const Reach& reach, const DepthImage& sensor_depth_m, const PixelRect& pixels) {
  float nearest_m = kHoldsNothing_m;
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    const float* const row = sensor_depth_m.row(v);
    for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
      nearest_m = row[u] < nearest_m ? row[u] : nearest_m;
    }
  }
  return reach.of(nearest_m, sensor_depth_m.width() + sensor_depth_m.height()) + 1;
}

/// Writes workspace.far_reach and .left_m of a row.
void find_far_reaches(const Reach& reach, const DepthImage& sensor_depth_m, const DepthImage& own_m,
                      float moved_m, const PixelRect& pixels, int v, AgingWorkspace& workspace) {
  const int most = own_m.width() + own_m.height();
  for (int u = pixels.u_begin; u < pixels.u_end; ++u) {
    const bool is_far = workspace.reach(u, v) > kMostRing;
    // One more for the least of 3 x 3 pixels.
    workspace.far_reach[u] = is_far ? reach.of(sensor_depth_m(u, v), most) + 1 : 0;
    workspace.left_m[u] = std::max(0.0f, own_m(u, v) - moved_m);
  }
}

}  // namespace

Reach::Reach(const Camera& camera, double moved_m)
    : spread_(std::max(camera.fx_px, camera.fy_px) * moved_m) {
  // Above r where S < spread / r: for a float the next one from there up says the same.
  borders_m_[0] = spread_ > 0 ? std::numeric_limits<float>::infinity() : 0.0f;
  for (int r = 1; r <= kMostRing; ++r) {
    const double border_m = spread_ / r;
    const auto rounded_m = static_cast<float>(border_m);
    borders_m_[r] = rounded_m >= border_m ? rounded_m : std::nextafter(rounded_m, kHoldsNothing_m);
  }
}

int Reach::of(float sensed_m, int most) const {
  return static_cast<int>(std::min(std::ceil(spread_ / sensed_m), static_cast<double>(most)));
}

void hold_far_reaching(const Reach& reach, const DepthImage& sensor_depth_m,
                       const DepthImage& own_m, float moved_m, AgingWorkspace& workspace,
                       DepthImage& out) {
  const int width = own_m.width();
  const int height = own_m.height();
  const PixelRect pixels = far_pixels(workspace);
  const int greatest = greatest_reach(reach, sensor_depth_m, pixels);
  const PixelRect touched = clip({pixels.u_begin - greatest, pixels.v_begin - greatest,
                                  pixels.u_end + greatest, pixels.v_end + greatest},
                                 width, height);
  const int widest = std::min({2 * greatest + 1, width, height});
  const auto level_count = static_cast<std::size_t>(level_of(widest)) + 1;
  std::vector<DepthImage>& levels = workspace.levels;
  levels.resize(std::max(levels.size(), level_count));
  const int columns = touched.u_end - touched.u_begin;
  for (std::size_t k = 0; k < level_count; ++k) {
    if (levels[k].width() != width || levels[k].height() != height)
      levels[k].resize(width, height, 0);
    for (int v = touched.v_begin; v < touched.v_end; ++v) {
      fill_endless(columns, levels[k].row(v) + touched.u_begin);
    }
  }
  workspace.left_m.resize(width);
  workspace.far_reach.resize(width);
  for (int v = pixels.v_begin; v < pixels.v_end; ++v) {
    find_far_reaches(reach, sensor_depth_m, own_m, moved_m, pixels, v, workspace);
    hold_row(workspace.left_m, workspace.far_reach, pixels, v, levels);
  }
  for (std::size_t k = level_count - 1; k > 0; --k) {
    hold_in_quarters(levels[k], 1 << (k - 1), touched, levels[k - 1]);
  }
  for (int v = touched.v_begin; v < touched.v_end; ++v) {
    take_least(levels[0].row(v) + touched.u_begin, columns, out.row(v) + touched.u_begin);
  }
}

}  // namespace berth
