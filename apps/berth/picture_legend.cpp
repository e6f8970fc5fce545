#include "apps/berth/picture_legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "apps/berth/picture_pairs.hpp"
#include "apps/berth/picture_text.hpp"

namespace berth::app {
namespace {

constexpr Rgb kCard{0x22, 0x27, 0x2F};
constexpr Rgb kTrack{0x2E, 0x34, 0x3D};

/// Of a link's row, in em: where its name begins, the least between two of its parts, what is left
/// free at the right, and widths of "0.137 m" and of a name that can still be told.
constexpr double kNameEm = 1.4;
constexpr double kGapEm = 0.3;
constexpr double kRightEm = 0.3;
constexpr double kNumberEm = 4.4;
constexpr double kLeastNameEm = 3;

/// What every part of the legend draws with; y is where the next part begins.
struct Legend {
  PictureCanvas& canvas;
  const PictureLayout& layout;
  const PictureInput& input;
  double em;
  double y;

  double left() const { return layout.legend.x; }
  double width() const { return layout.legend.width; }
  double right() const { return left() + width(); }
};

int count_of(const PictureInput& input, LinkStatus status) {
  return static_cast<int>(std::ranges::count(*input.links, status, &LinkResult::status));
}

/// Links with a distance, nearest first, then those with none in range, then those not visible.
/// Links that stand where they stand come after those with a distance that move.
std::vector<PictureLink> by_nearness(const PictureInput& input) {
  std::vector<PictureLink> links = *input.links;
  std::ranges::stable_sort(links, {}, [&](const LinkResult& link) {
    const bool ok = link.status == LinkStatus::ok;
    return std::tuple{link.status, ok && !link.is_moved, ok ? link.distance_m : 0};
  });
  return links;
}

void heading(Legend& legend, const std::string& left, const std::string& right) {
  const double middle = legend.y + 1.05 * legend.em;
  legend.canvas.text({legend.left(), middle}, left, {0.82 * legend.em, true}, kFaintInk);
  legend.canvas.text({legend.right(), middle}, right, {0.82 * legend.em}, kFaintInk, Align::right);
  legend.y += kHeadingEm * legend.em;
}

/// The message of the picture in two lines, and the colour that goes with it.
std::tuple<std::string, std::string, Rgb> headline(const PictureInput& input) {
  const std::vector<PictureLink> links = by_nearness(input);
  if (links.empty()) return {"no links", "nothing was evaluated", kFaintInk};
  const LinkResult& first = links.front();
  if (first.status == LinkStatus::ok) {
    return {distance_text(first, input.range_m), first.link, link_color(first.id)};
  }
  if (first.status == LinkStatus::none_in_range)
    return {"none within " + range_text(input.range_m), "of any visible link", kFaintInk};
  return {"robot not visible", "nothing is known of its distance", kFaintInk};
}

void draw_card(Legend& legend) {
  const double em = legend.em, x = legend.left() + 1.1 * em;
  const auto [big, small, color] = headline(legend.input);
  legend.canvas.fill_box({legend.left(), legend.y, legend.width(), (kCardEm - 0.5) * em}, kCard,
                         0.4 * em);
  legend.canvas.fill_box({legend.left(), legend.y, 0.4 * em, (kCardEm - 0.5) * em}, color,
                         0.2 * em);
  const double room_px = legend.width() - 1.6 * em;
  const double big_em = big.size() > 8 ? 1.25 : 2.1;
  const Font big_font{big_em * em, true};
  const double fitting = std::min(1.0, room_px / legend.canvas.text_width_px(big, big_font));
  legend.canvas.text({x, legend.y + 1.65 * em}, big, {fitting * big_font.size_px, true}, kInk);
  const Font name_font{em, true};
  legend.canvas.text({x, legend.y + 3.4 * em}, fit_text(legend.canvas, small, name_font, room_px),
                     name_font, kInk);
  const int hidden = count_of(legend.input, LinkStatus::not_visible);
  const std::string counts = fmt::format(
      "{} of {} links in range{}", count_of(legend.input, LinkStatus::ok),
      legend.input.links->size(), hidden ? fmt::format(", {} not visible", hidden) : "");
  legend.canvas.text({x, legend.y + 4.75 * em},
                     fit_text(legend.canvas, counts, {0.8 * em}, room_px), {0.8 * em}, kFaintInk);
  legend.y += kCardEm * em;
}

void draw_bar(Legend& legend, const LinkResult& link, BoxPx box) {
  legend.canvas.fill_box(box, kTrack, box.height / 2);
  const double share = std::clamp(link.distance_m / legend.input.range_m, 0.0, 1.0);
  box.width = std::max(box.height, share * box.width);
  legend.canvas.fill_box(box, link_color(link.id), box.height / 2);
}

void draw_link_row(Legend& legend, const LinkResult& link, double x, double y, bool nearest) {
  const TablePlan& plan = legend.layout.table;
  const double em = legend.em, row = plan.row_em * em, middle = y + row / 2;
  const double right = x + plan.column_em * em;
  const Font font{em * (plan.row_em < 1.2 ? 0.8 : plan.row_em < 1.5 ? 0.86 : 0.95), nearest};
  const bool ok = link.status == LinkStatus::ok;
  if (nearest) legend.canvas.fill_box({x, y, right - x, row}, kTrack, 0.3 * em);
  legend.canvas.fill_box({x + 0.25 * em, middle - 0.38 * em, 0.76 * em, 0.76 * em},
                         link_color(link.id), 0.15 * em);
  const LinkRow row_text = link_row(legend.canvas, link, legend.input.range_m, plan, font, em);
  const bool seen = link.status != LinkStatus::not_visible;
  legend.canvas.text({x + kNameEm * em, middle}, row_text.name, font, seen ? kInk : kFaintInk);
  legend.canvas.text({right - kRightEm * em, middle}, row_text.distance, font,
                     ok ? kInk : kFaintInk, Align::right);
  const double bar_left = x + (kNameEm + kGapEm + plan.name_em) * em;
  if (row_text.has_bar) {
    const double bar_right = right - (kRightEm + kNumberEm) * em;
    draw_bar(legend, link, {bar_left, middle - 0.18 * em, bar_right - bar_left, 0.36 * em});
  }
}

void draw_key(Legend& legend) {
  const double em = legend.em, middle = legend.y + 0.95 * em;
  const PointPx robot{legend.left() + 0.65 * em, middle}, obstacle{robot.x + 7.2 * em, middle};
  draw_robot_end(legend.canvas, robot, kFaintInk, 0.9 * em);
  draw_obstacle_end(legend.canvas, obstacle, kFaintInk, 0.9 * em);
  legend.canvas.text({robot.x + 0.75 * em, middle}, "on the robot", {0.8 * em}, kFaintInk);
  legend.canvas.text({obstacle.x + 0.75 * em, middle}, "nearest obstacle", {0.8 * em}, kFaintInk);
  legend.y += kKeyEm * em;
  if (!has_hidden(legend.input)) return;
  const double y = legend.y + 0.4 * em;
  draw_pair_line(legend.canvas, {legend.left(), y}, {legend.left() + 3 * em, y}, true, kFaintInk,
                 0.16 * em, 1);
  legend.canvas.text({legend.left() + 3.6 * em, y}, "to what no camera sees", {0.8 * em},
                     kFaintInk);
  legend.y += kHiddenKeyEm * em;
}

void draw_table(Legend& legend) {
  const TablePlan& plan = legend.layout.table;
  std::vector<PictureLink> links = by_nearness(legend.input);
  if (links.empty()) return;
  const LinkId nearest = links.front().status == LinkStatus::ok ? links.front().id : kNoLink;
  const std::size_t left_out = links.size() - plan.shown;
  links.resize(plan.shown);
  // The same place in every frame is easier to follow than a place that follows the distance.
  std::ranges::sort(links, {}, &LinkResult::id);

  heading(legend, "LINKS", "distance, up to " + range_text(legend.input.range_m));
  for (int i = 0; i < plan.shown; ++i) {
    const double x =
        legend.left() + (i / plan.rows) * (legend.width() - plan.column_em * legend.em);
    const double y = legend.y + (i % plan.rows) * plan.row_em * legend.em;
    draw_link_row(legend, links[i], x, y, links[i].id == nearest);
  }
  legend.y += plan.rows * plan.row_em * legend.em;
  if (left_out > 0) {
    legend.canvas.text({legend.left() + 1.4 * legend.em, legend.y + plan.row_em * legend.em / 2},
                       fmt::format("and {} more, none of them nearer", left_out),
                       {0.84 * legend.em}, kFaintInk);
    legend.y += plan.row_em * legend.em;
  }
  draw_key(legend);
}

void draw_swatch(Legend& legend, PixelFate fate, const BoxPx& box) {
  if (fate != PixelFate::robot || !legend.input.robot) {
    const Rgb grey = fate_color(PixelFate::obstacle);
    const bool kept = fate == PixelFate::obstacle || fate == PixelFate::no_reading;
    legend.canvas.fill_box(box, kept ? fate_color(fate) : mix(grey, fate_color(fate), 0.6),
                           box.height / 5);
    if (fate == PixelFate::no_reading)
      legend.canvas.stroke_box(box, kFaintInk, box.height / 12, box.height / 5);
    return;
  }
  // The robot's pixels have the links' colours.
  for (int k = 0; k < 4; ++k)
    legend.canvas.fill_box({box.x + k * box.width / 4, box.y, box.width / 4, box.height},
                           link_color(static_cast<LinkId>(k + 1)));
}

void draw_fates(Legend& legend) {
  const int columns = legend.layout.table.columns;
  const double em = legend.em, row = kFateRowEm * em;
  const std::vector<PixelFate> fates = shown_fates(*legend.input.obstacles);
  const int rows = (static_cast<int>(fates.size()) + columns - 1) / columns;
  const double column = legend.layout.table.column_em * em;
  heading(legend, "PIXELS", "count");
  for (int i = 0; i < static_cast<int>(fates.size()); ++i) {
    const PixelFate fate = fates[i];
    const double x = legend.left() + (i / rows) * (legend.width() - column);
    const double middle = legend.y + (i % rows + 0.5) * row;
    const std::int64_t count = legend.input.obstacles->count_of(fate);
    const Rgb ink = count > 0 ? kInk : kFaintInk;
    draw_swatch(legend, fate, {x + 0.25 * em, middle - 0.38 * em, 0.76 * em, 0.76 * em});
    legend.canvas.text({x + 1.4 * em, middle}, fate_text(fate), {0.84 * em}, ink);
    legend.canvas.text({x + column - 0.3 * em, middle}, grouped(count), {0.84 * em}, ink,
                       Align::right);
  }
  legend.y += rows * row;
}

void draw_ticks(Legend& legend, const DepthTone& tone, double y) {
  double free_from = -1;
  const double width = legend.width();
  for (const double depth_m : {0.1, 0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 7.0,
                               10.0, 15.0, 20.0, 40.0}) {
    const double share = std::log(depth_m / tone.near_m) / std::log(tone.far_m / tone.near_m);
    if (!(share >= 0 && share <= 1) || share * width < free_from) continue;
    const double x = legend.left() + share * width;
    legend.canvas.line({x, y}, {x, y + 0.25 * legend.em}, kFaintInk, 0.08 * legend.em);
    const Align align = share < 0.05 ? Align::left : share > 0.92 ? Align::right : Align::middle;
    legend.canvas.text({x, y + 0.85 * legend.em}, fmt::format("{:.1f}", depth_m),
                       {0.78 * legend.em}, kFaintInk, align);
    free_from = share * width + 2.4 * legend.em;
  }
}

void draw_depth_scale(Legend& legend, const DepthTone& tone) {
  heading(legend, "DEPTH", std::isnan(tone.near_m) ? "no readings" : "metres");
  if (std::isnan(tone.near_m)) return;
  const double width = legend.width();
  constexpr int kSteps = 64;
  for (int k = 0; k < kSteps; ++k) {
    const double depth_m = tone.near_m * std::pow(tone.far_m / tone.near_m, (k + 0.5) / kSteps);
    const double x = std::round(legend.left() + k * width / kSteps);
    const double next = std::round(legend.left() + (k + 1) * width / kSteps);
    legend.canvas.fill_box({x, legend.y, next - x, 0.9 * legend.em}, tone(depth_m));
  }
  draw_ticks(legend, tone, legend.y + 0.9 * legend.em);
}

}  // namespace

LinkRow link_row(const PictureCanvas& canvas, const LinkResult& link, double range_m,
                 const TablePlan& plan, const Font& font, double em_px) {
  // The distance to what is seen has no room beside "unknown 0 m"; it stands at the link's line.
  const std::string distance = short_distance_text(link, range_m);
  const bool is_number = canvas.text_width_px(distance, font) <= kNumberEm * em_px;
  if (is_number) {
    return {fit_text(canvas, link.link, font, plan.name_em * em_px), distance,
            link.status == LinkStatus::ok};
  }
  // Words take the bar's place, and the name's where they are many.
  const double room_px = (plan.column_em - kNameEm - kGapEm - kRightEm) * em_px;
  const std::string words =
      fit_text(canvas, distance, font, room_px - std::min(kLeastNameEm, plan.name_em) * em_px);
  return {fit_text(canvas, link.link, font, room_px - canvas.text_width_px(words, font)), words,
          false};
}

void draw_legend(PictureCanvas& canvas, const PictureLayout& layout, const PictureInput& input,
                 const DepthTone& tone) {
  Legend legend{canvas, layout, input, layout.em_px, layout.legend.y};
  if (input.links) {
    draw_card(legend);
    draw_table(legend);
  }
  if (input.obstacles) draw_fates(legend);
  draw_depth_scale(legend, tone);
}

}  // namespace berth::app
