#include "apps/berth/picture_layout.hpp"

#include <algorithm>
#include <cmath>

namespace berth::app {
namespace {

constexpr double kMarginEm = 0.9;
constexpr double kTitleEm = 2.7;

int enlargement(const DepthView& image) {
  constexpr int kLeastWidth = 960, kMostHeight = 2160;
  const int wanted = (kLeastWidth + image.width - 1) / image.width;
  return std::clamp(wanted, 1, std::max(1, kMostHeight / image.height));
}

double longest_name_em(const PictureInput& input) {
  const PictureCanvas measure(1, 1, kBlack);
  double longest = 0;
  for (const LinkResult& link : input.links ? *input.links : std::vector<PictureLink>{})
    longest = std::max(longest, measure.text_width_px(link.link, {100, true}) / 100);
  return std::clamp(longest + 0.3, 4.0, 11.0);
}

/// The legend without the table's rows.
double fixed_height_em(const PictureInput& input, int columns) {
  const auto fate_count = input.obstacles ? std::ssize(shown_fates(*input.obstacles)) : 0;
  const auto fate_rows = static_cast<double>((fate_count + columns - 1) / columns);
  const double fates = input.obstacles ? kHeadingEm + kFateRowEm * fate_rows : 0;
  const double links =
      input.links ? kCardEm + kHeadingEm + kKeyEm + (has_hidden(input) ? kHiddenKeyEm : 0) : 0;
  return links + fates + kScaleEm;
}

TablePlan plan_table(const PictureInput& input, double height_em) {
  const int links = input.links ? static_cast<int>(input.links->size()) : 0;
  TablePlan plan;
  plan.name_em = longest_name_em(input);
  plan.column_em = std::max(plan.name_em + 10.4, 17.0);
  for (const auto& [columns, row_em] :
       {std::pair{1, 1.85}, {1, 1.55}, {1, 1.25}, {2, 1.25}, {2, 1.05}}) {
    const double free_em = height_em - fixed_height_em(input, columns);
    const int fitting = std::max(4, static_cast<int>(free_em / row_em));
    plan.columns = columns;
    plan.row_em = row_em;
    plan.shown = std::min(links, columns * fitting);
    if (plan.shown == links) break;
  }
  // The line that counts the links left out takes a row of its own.
  if (plan.shown < links) plan.shown -= plan.columns;
  plan.rows = (plan.shown + plan.columns - 1) / plan.columns;
  return plan;
}

}  // namespace

bool has_hidden(const PictureInput& input) {
  if (!input.links) return false;
  return std::ranges::any_of(*input.links, [](const LinkResult& link) {
    return link.status == LinkStatus::ok && link.obstacle_is != ObstacleKind::occupied;
  });
}

std::vector<PixelFate> shown_fates(const ObstacleImage& obstacles) {
  std::vector<PixelFate> fates;
  for (int i = 0; i < kPixelFateCount; ++i) {
    const auto fate = static_cast<PixelFate>(i);
    if (fate <= PixelFate::flying_patch || obstacles.count_of(fate) > 0) fates.push_back(fate);
  }
  return fates;
}

PictureLayout layout_picture(const PictureInput& input) {
  PictureLayout layout;
  layout.factor = enlargement(input.sensor_depth_m);
  layout.image.width = input.sensor_depth_m.width * layout.factor;
  layout.image.height = input.sensor_depth_m.height * layout.factor;
  const double em = std::max(
      11.0,
      std::min(std::sqrt(layout.image.width * layout.image.height) / 52, layout.image.height / 42));
  const double margin = std::round(kMarginEm * em);
  layout.em_px = em;
  layout.table = plan_table(input, layout.image.height / em);

  layout.image.x = margin;
  layout.image.y = std::round(kTitleEm * em);
  const int columns = layout.table.columns;
  const bool has_more = input.links && layout.table.shown < std::ssize(*input.links);
  const double legend_em = fixed_height_em(input, columns) +
                           layout.table.row_em * (layout.table.rows + (has_more ? 1 : 0));
  layout.legend = {layout.image.x + layout.image.width + 1.2 * margin, layout.image.y,
                   (columns * layout.table.column_em + (columns - 1) * kMarginEm) * em,
                   std::max(layout.image.height, legend_em * em)};
  layout.width_px = static_cast<int>(std::ceil(layout.legend.x + layout.legend.width + margin));
  layout.height_px = static_cast<int>(std::ceil(layout.legend.y + layout.legend.height + margin));
  layout.title = {margin, 0, layout.width_px - 2 * margin, layout.image.y};
  return layout;
}

}  // namespace berth::app
