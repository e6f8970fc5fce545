#include "berth/scene/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace berth {
namespace {

using Line = std::vector<std::string>;
/// The others are numbers, and stand at the right of their column.
constexpr std::size_t kTextColumns = 2;

std::string pixel_text(Pixel pixel) { return fmt::format("({}, {})", pixel.u, pixel.v); }

std::string distance_text(const LinkDistance& link, bool has_bounds) {
  const bool ok = link.status == LinkStatus::ok;
  const std::string distance = ok ? fmt::format("{:.4f}", link.distance_m) : "-";
  const bool is_known = !has_bounds || std::isnan(link.lower_bound_m) ||
                        (ok && link.lower_bound_m == link.distance_m);
  if (is_known) return distance;
  // Cut, not rounded: a bound must not be told as more than it is.
  const double bound_m = std::floor(1e4 * link.lower_bound_m) / 1e4;
  return ok ? fmt::format("{:.4f} to {}", bound_m, distance)
            : fmt::format("{:.4f} or more", bound_m);
}

Line line_of(const LinkDistance& link, const std::string& name, bool has_bounds) {
  const bool ok = link.status == LinkStatus::ok;
  return {name,
          std::string(name_of(link.status)),
          distance_text(link, has_bounds),
          ok ? pixel_text(link.robot_pixel) : "-",
          ok ? pixel_text(link.obstacle_pixel) : "-",
          fmt::format("{}", link.robot_pixels)};
}

std::string seen_text(const LinkVisibility& link) {
  return link.surface.is_known() ? fmt::format("{:.0f} %", 100 * link.surface.seen) : "-";
}

bool has_doubt(const LinkVisibility& link) { return !std::isnan(link.doubtful_distance_m); }

std::string doubtful_text(const LinkVisibility& link) {
  return has_doubt(link) ? fmt::format("{:.4f}", link.doubtful_distance_m) : "-";
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

}  // namespace

std::string result_table(const FrameResult& result) {
  const std::vector<LinkDistance>& links = result.distances->links;
  assert(result.link_names.size() == links.size());
  std::vector<Line> lines = {
      {"link", "status", "distance [m]", "robot pixel", "obstacle pixel", "robot pixels"}};
  if (result.visibility) lines.front().push_back("seen");
  const bool has_doubts = result.visibility && std::any_of(result.visibility->begin(),
                                                           result.visibility->end(), has_doubt);
  if (has_doubts) lines.front().push_back("doubtful [m]");
  for (std::size_t i = 0; i < links.size(); ++i) {
    lines.push_back(line_of(links[i], result.link_names[i], result.has_bounds));
    if (result.visibility) lines.back().push_back(seen_text((*result.visibility)[i]));
    if (has_doubts) lines.back().push_back(doubtful_text((*result.visibility)[i]));
  }
  const std::vector<std::size_t> widths = widths_of(lines);
  std::string table;
  for (const Line& line : lines) table += padded(line, widths);
  return table;
}

}  // namespace berth
