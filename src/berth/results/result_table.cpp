#include "berth/results/result_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace berth {
namespace {

using Line = std::vector<std::string>;
/// The others are numbers, and stand at the right of their column.
constexpr std::size_t kTextColumns = 2;

std::string pixel_text(Pixel pixel) { return fmt::format("({}, {})", pixel.u, pixel.v); }

std::string distance_text(const LinkResult& link, bool has_bounds) {
  const bool ok = link.status == LinkStatus::ok || link.has_distance();
  const std::string distance = ok ? fmt::format("{:.4f}", link.distance_m) : "-";
  const bool is_known = !has_bounds || std::isnan(link.lower_bound_m) ||
                        (ok && link.lower_bound_m == link.distance_m);
  if (is_known) return distance;
  // Cut, not rounded: a bound must not be told as more than it is.
  const double bound_m = std::floor(1e4 * link.lower_bound_m) / 1e4;
  return ok ? fmt::format("{:.4f} to {}", bound_m, distance)
            : fmt::format("{:.4f} or more", bound_m);
}

Line image_line(const LinkResult& link, const Result& result) {
  const bool ok = link.status == LinkStatus::ok;
  return {distance_text(link, result.has_bounds), ok ? pixel_text(link.image.robot_pixel) : "-",
          ok ? pixel_text(link.obstacle_pixel) : "-", fmt::format("{}", link.image.robot_pixels)};
}

/// Within 1 mm, unless a deadline cut the search, the distance says enough without its bound.
constexpr float kTellBound_m = 0.0015F;

std::string mesh_distance_text(const LinkResult& link) {
  const bool is_sure = link.has_distance() && link.distance_m - link.lower_bound_m < kTellBound_m;
  const bool is_none = link.status == LinkStatus::none_in_range;
  return distance_text(link, !is_sure && !is_none && link.status != LinkStatus::stale);
}

Line mesh_line(const LinkResult& link, const Result& result) {
  const bool known = link.has_distance();
  const std::string occupied =
      link.occupied.is_known() ? fmt::format("{:.4f}", link.occupied.distance_m) : "-";
  return {mesh_distance_text(link), known ? std::string(name_of(link.obstacle_is)) : "-", occupied,
          known ? std::string(result.camera_of(link)) : "-",
          known ? pixel_text(link.obstacle_pixel) : "-"};
}

std::string seen_text(const LinkVisibility& link) {
  return link.surface.is_known() ? fmt::format("{:.0f} %", 100 * link.surface.seen) : "-";
}

bool has_rejected(const LinkVisibility& link) { return !std::isnan(link.rejected_distance_m); }

std::string rejected_text(const LinkVisibility& link) {
  return has_rejected(link) ? fmt::format("{:.4f}", link.rejected_distance_m) : "-";
}

/// The room that a link needs, and the share of the robot's speed that it allows; cut, not rounded.
void add_separation(const LinkSeparation& link, Line& line) {
  const bool is_known = !std::isnan(link.required_m);
  line.push_back(is_known ? fmt::format("{:.3f}", link.required_m) : "-");
  line.push_back(link.is_moved ? fmt::format("{:.0f} %", std::floor(100 * link.speed_scale)) : "-");
}

std::vector<std::size_t> widths_of(const std::vector<Line>& lines) {
  std::vector<std::size_t> widths(lines.front().size());
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  return widths;
}

std::string padded(const Line& line, const std::vector<std::size_t>& widths) {
  std::string text;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (i > 0) text += "  ";
    text += i < kTextColumns ? fmt::format("{:<{}}", line[i], widths[i])
                             : fmt::format("{:>{}}", line[i], widths[i]);
  }
  return text + "\n";
}

/// Links that no joint moves come last: they stand on their table, as near as they always do.
std::vector<std::size_t> moved_first(const Result& result) {
  std::vector<std::size_t> order(result.links.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return result.links[i].is_moved; });
  return order;
}

struct Columns {
  Line names;
  Line (*cells)(const LinkResult& link, const Result& result);
};

Columns columns_of(const Result& result) {
  if (result.compares_images) {
    return {{"distance [m]", "robot pixel", "obstacle pixel", "robot pixels"}, image_line};
  }
  return {{"distance [m]", "nearest is", "to occupied [m]", "camera", "obstacle pixel"}, mesh_line};
}

}  // namespace

std::string result_table(const Result& result) {
  std::vector<Line> lines = {{"link", "status"}};
  const Columns columns = columns_of(result);
  lines.front().insert(lines.front().end(), columns.names.begin(), columns.names.end());
  if (result.has_visibility) lines.front().push_back("seen");
  const bool has_any_rejected =
      std::ranges::any_of(result.links, has_rejected, &LinkResult::visibility);
  if (has_any_rejected) lines.front().push_back("rejected [m]");
  if (result.separation) lines.front().insert(lines.front().end(), {"needs [m]", "may go"});
  for (const std::size_t i : moved_first(result)) {
    const LinkResult& link = result.links[i];
    Line& line = lines.emplace_back(Line{link.link, std::string(name_of(link.status))});
    const Line cells = columns.cells(link, result);
    line.insert(line.end(), cells.begin(), cells.end());
    if (result.has_visibility) line.push_back(seen_text(link.visibility));
    if (has_any_rejected) line.push_back(rejected_text(link.visibility));
    if (result.separation) add_separation(result.separation->links[i], line);
  }
  const std::vector<std::size_t> widths = widths_of(lines);
  std::string table;
  for (const Line& line : lines) table += padded(line, widths);
  return table;
}

}  // namespace berth
