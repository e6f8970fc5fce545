#include "apps/berth/residual_histogram.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "apps/berth/residual_colors.hpp"

namespace berth::app {
namespace {

constexpr double kWidth = 560, kHeight = 250;
constexpr double kLeft = 44, kRight = 12, kTop = 12, kBottom = 46;
constexpr double kBin = (kWidth - kLeft - kRight) / ResidualHistogram::kBins;

double x_of(double bin) { return kLeft + bin * kBin; }

/// Steps along the bins' tops, from the axis to the axis.
std::string outline_path(const ResidualHistogram& histogram, double most) {
  std::string path = fmt::format("M{:.1f} {:.1f}", x_of(0), kHeight - kBottom);
  for (int i = 0; i < ResidualHistogram::kBins; ++i) {
    const double y = kHeight - kBottom - (kHeight - kTop - kBottom) * histogram.share(i) / most;
    fmt::format_to(std::back_inserter(path), "V{:.1f}H{:.1f}", y, x_of(i + 1));
  }
  return path + fmt::format("V{:.1f}", kHeight - kBottom);
}

double most_of(const ResidualHistogram& histogram) {
  double most = 0;
  for (int i = 0; i < ResidualHistogram::kBins; ++i) most = std::max(most, histogram.share(i));
  return most;
}

std::string axis() {
  std::string svg;
  const auto out = std::back_inserter(svg);
  const double y = kHeight - kBottom;
  fmt::format_to(out, R"(<path class="axis" d="M{:.1f} {:.1f}H{:.1f}"/>)", kLeft, y,
                 kWidth - kRight);
  for (int mm = -60; mm <= 60; mm += 20) {
    const double x =
        x_of(ResidualHistogram::kBins / 2 + 0.5 + mm / (1e3 * ResidualHistogram::kStep_m));
    fmt::format_to(out, R"(<path class="axis" d="M{0:.1f} {1:.1f}v5"/>)", x, y);
    fmt::format_to(out,
                   R"(<text class="label" x="{:.1f}" y="{:.1f}" text-anchor="middle">{}{}</text>)",
                   x, y + 19, mm > 0 ? "+" : "", mm);
  }
  fmt::format_to(out,
                 R"(<text class="label" x="{:.1f}" y="{:.1f}">◂ nearer than the model</text>)"
                 R"(<text class="label" x="{:.1f}" y="{:.1f}" text-anchor="middle">mm</text>)"
                 R"(<text class="label" x="{:.1f}" y="{:.1f}" text-anchor="end">farther ▸</text>)",
                 kLeft, kHeight - 8, x_of(ResidualHistogram::kBins / 2 + 0.5), kHeight - 8,
                 kWidth - kRight, kHeight - 8);
  return svg;
}

}  // namespace

void ResidualHistogram::add(DepthView residual_m) {
  for (int v = 0; v < residual_m.height; ++v) {
    for (int u = 0; u < residual_m.width; ++u) {
      const double off_m = residual_m(u, v);
      if (!(std::abs(off_m) < kResidualScale_m)) continue;
      const int bin = static_cast<int>(std::lround(off_m / kStep_m)) + kBins / 2;
      ++bins_[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))];
      ++count_;
    }
  }
}

double ResidualHistogram::share(int bin) const {
  if (count_ == 0) return 0;
  return static_cast<double>(bins_[static_cast<std::size_t>(bin)]) / static_cast<double>(count_);
}

std::string histogram_svg(const ResidualHistogram& before, const ResidualHistogram& after) {
  const double most = std::max({most_of(before), most_of(after), 1e-9});
  std::string svg = fmt::format(
      R"(<svg viewBox="0 0 {0} {1}" role="img" aria-label="How often readings differ from the model by how much, before and after">)",
      kWidth, kHeight);
  const auto out = std::back_inserter(svg);
  fmt::format_to(out, R"(<path class="after" d="{}"/>)", outline_path(after, most));
  fmt::format_to(out, R"(<path class="before" d="{}"/>)", outline_path(before, most));
  fmt::format_to(out,
                 R"(<text class="label" x="{:.1f}" y="{:.1f}" text-anchor="end">{:.0f} %</text>)",
                 kLeft - 6, kTop + 10, 100 * most);
  const double x = x_of(ResidualHistogram::kBins / 2 + 0.5);
  fmt::format_to(out, R"(<path class="zero" d="M{:.1f} {:.1f}V{:.1f}"/>)", x, kTop,
                 kHeight - kBottom);
  return svg + axis() + "</svg>";
}

}  // namespace berth::app
