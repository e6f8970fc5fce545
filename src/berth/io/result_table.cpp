#include "berth/io/result_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace berth {
namespace {

constexpr std::size_t kColumns = 6;
using Line = std::array<std::string, kColumns>;

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
          status_name(link.status),
          distance_text(link, has_bounds),
          ok ? pixel_text(link.robot_pixel) : "-",
          ok ? pixel_text(link.obstacle_pixel) : "-",
          fmt::format("{}", link.robot_pixels)};
}

std::array<std::size_t, kColumns> widths_of(const std::vector<Line>& lines) {
  std::array<std::size_t, kColumns> widths{};
  for (const Line& line : lines) {
    for (std::size_t i = 0; i < kColumns; ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  return widths;
}

}  // namespace

std::string result_table(const FrameResult& result) {
  const std::vector<LinkDistance>& links = result.distances->links;
  assert(result.link_names.size() == links.size());
  std::vector<Line> lines = {
      {"link", "status", "distance [m]", "robot pixel", "obstacle pixel", "robot pixels"}};
  for (std::size_t i = 0; i < links.size(); ++i) {
    lines.push_back(line_of(links[i], result.link_names[i], result.has_bounds));
  }
  const auto width = widths_of(lines);
  std::string table;
  for (const Line& line : lines) {
    table += fmt::format("{:<{}}  {:<{}}  {:>{}}  {:>{}}  {:>{}}  {:>{}}\n", line[0], width[0],
                         line[1], width[1], line[2], width[2], line[3], width[3], line[4], width[4],
                         line[5], width[5]);
  }
  return table;
}

}  // namespace berth
