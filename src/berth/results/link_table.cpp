#include "berth/results/link_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace berth {
namespace {

/// The others are numbers, and stand at the right of their column.
constexpr std::size_t kTextColumns = 2;

}  // namespace

LinkTable::LinkTable(const Cells& heading) : lines_{{"link", "status"}} {
  lines_.front().insert(lines_.front().end(), heading.begin(), heading.end());
}

void LinkTable::add(const LinkResult& link, const Cells& cells) {
  Cells& line = lines_.emplace_back(Cells{link.link, std::string(name_of(link.status))});
  line.insert(line.end(), cells.begin(), cells.end());
}

std::string LinkTable::text() const {
  std::vector<std::size_t> widths(lines_.front().size());
  for (const Cells& line : lines_) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  std::string text;
  for (const Cells& line : lines_) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (i > 0) text += "  ";
      text += i < kTextColumns ? fmt::format("{:<{}}", line[i], widths[i])
                               : fmt::format("{:>{}}", line[i], widths[i]);
    }
    text += "\n";
  }
  return text;
}

std::vector<std::size_t> moved_first(const Result& result) {
  std::vector<std::size_t> order(result.links.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return result.links[i].is_moved; });
  return order;
}

std::string distance_text(const LinkResult& link, bool has_bounds) {
  const bool ok = link.status == LinkStatus::ok || link.has_distance();
  const std::string distance = ok ? fmt::format("{:.4f}", link.distance_m) : "-";
  // Of a link that no camera sees, or whose space none shows, the bound promises nothing.
  const bool is_unseen =
      link.status == LinkStatus::not_seen || link.status == LinkStatus::not_observed;
  const bool has_bound = has_bounds && !std::isnan(link.lower_bound_m) && (ok || !is_unseen);
  if (!has_bound || (ok && link.lower_bound_m == link.distance_m)) return distance;
  // Cut, not rounded: a bound must not be told as more than it is.
  const double bound_m = std::floor(1e4 * link.lower_bound_m) / 1e4;
  return ok ? fmt::format("{:.4f} to {}", bound_m, distance)
            : fmt::format("{:.4f} or more", bound_m);
}

std::string pixel_text(Pixel pixel) { return fmt::format("({}, {})", pixel.u, pixel.v); }

}  // namespace berth
