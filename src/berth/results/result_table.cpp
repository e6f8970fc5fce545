#include "berth/results/result_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "berth/results/link_table.hpp"

namespace berth {
namespace {

/// Within 1 mm, unless a deadline cut the search, the distance says enough without its bound.
constexpr float kTellBound_m = 0.0015F;

std::string sure_distance_text(const LinkResult& link) {
  const bool is_sure = link.has_distance() && link.distance_m - link.lower_bound_m < kTellBound_m;
  const bool is_none = link.status == LinkStatus::none_in_range;
  return distance_text(link, !is_sure && !is_none && link.status != LinkStatus::stale);
}

LinkTable::Cells cells_of(const LinkResult& link, const Result& result) {
  const bool known = link.has_distance();
  const std::string occupied =
      link.occupied.is_known() ? fmt::format("{:.4f}", link.occupied.distance_m) : "-";
  return {sure_distance_text(link), known ? std::string(name_of(link.obstacle_is)) : "-", occupied,
          known ? std::string(result.camera_of(link)) : "-",
          known ? pixel_text(link.obstacle_pixel) : "-"};
}

/// Such as "0.1370 table".
std::string known_text(const LinkResult& link, const Result& result) {
  if (!link.known.is_known()) return "-";
  return fmt::format("{:.4f} {}", link.known.distance_m, result.known_link_of(link.known));
}

std::string seen_text(const LinkVisibility& link) {
  return link.surface.is_known() ? fmt::format("{:.0f} %", 100 * link.surface.seen) : "-";
}

bool has_rejected(const LinkVisibility& link) { return !std::isnan(link.rejected_distance_m); }

std::string rejected_text(const LinkVisibility& link) {
  return has_rejected(link) ? fmt::format("{:.4f}", link.rejected_distance_m) : "-";
}

/// The room that a link needs, and the share of the robot's speed that it allows; cut, not rounded.
void add_separation(const LinkSeparation& link, LinkTable::Cells& cells) {
  const bool is_known = !std::isnan(link.required_m);
  cells.push_back(is_known ? fmt::format("{:.3f}", link.required_m) : "-");
  cells.push_back(link.is_moved ? fmt::format("{:.0f} %", std::floor(100 * link.speed_scale))
                                : "-");
}

}  // namespace

std::string result_table(const Result& result) {
  LinkTable::Cells heading = {"distance [m]", "nearest is", "to occupied [m]", "camera",
                              "obstacle pixel"};
  if (result.link_names) heading.push_back("to known [m]");
  if (result.has_visibility) heading.push_back("seen");
  const bool has_any_rejected =
      std::ranges::any_of(result.links, has_rejected, &LinkResult::visibility);
  if (has_any_rejected) heading.push_back("rejected [m]");
  if (result.separation) heading.insert(heading.end(), {"needs [m]", "may go"});
  LinkTable table(heading);
  for (const std::size_t i : moved_first(result)) {
    const LinkResult& link = result.links[i];
    LinkTable::Cells cells = cells_of(link, result);
    if (result.link_names) cells.push_back(known_text(link, result));
    if (result.has_visibility) cells.push_back(seen_text(link.visibility));
    if (has_any_rejected) cells.push_back(rejected_text(link.visibility));
    if (result.separation) add_separation(result.separation->links[i], cells);
    table.add(link, cells);
  }
  return table.text();
}

}  // namespace berth
