#include "apps/berth/picture_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace berth::app {
namespace {

/// Cuts UTF-8 between code points.
std::vector<std::string> code_points(const std::string& text) {
  std::vector<std::string> points;
  for (const char c : text) {
    const bool continues = (static_cast<unsigned char>(c) & 0xC0) == 0x80;
    if (continues && !points.empty()) {
      points.back() += c;
    } else {
      points.emplace_back(1, c);
    }
  }
  return points;
}

/// Nobody knows whether something is there.
bool is_unknown_contact(const LinkResult& link) {
  return link.status == LinkStatus::ok && link.distance_m == 0 && !is_contact(link);
}

}  // namespace

std::string range_text(double range_m) {
  const bool is_whole_cm = std::abs(range_m - std::round(range_m * 100) / 100) < 1e-9;
  return fmt::format("{:.{}f} m", range_m, is_whole_cm ? 2 : 3);
}

bool is_contact(const LinkResult& link) {
  return link.distance_m == 0 && link.obstacle_is == ObstacleKind::occupied;
}

std::string distance_text(const LinkResult& link, double range_m) {
  const std::string text = short_distance_text(link, range_m);
  if (!is_unknown_contact(link)) return text;
  // A known obstacle is named as well.
  if (std::isfinite(link.occupied.distance_m))
    return fmt::format("{}, seen {:.3f} m", text, link.occupied.distance_m);
  return text + ", nothing seen within " + range_text(range_m);
}

std::string short_distance_text(const LinkResult& link, double range_m) {
  switch (link.status) {
    case LinkStatus::ok:
      if (link.distance_m != 0) return fmt::format("{:.3f} m", link.distance_m);
      return is_contact(link) ? "contact" : "unknown 0 m";
    case LinkStatus::none_in_range:
      return "none within " + range_text(range_m);
    case LinkStatus::not_visible:
      return "not visible";
    case LinkStatus::cut_short:
      return "not known in time";
    case LinkStatus::stale:
      return "stale";
    case LinkStatus::not_seen:
      return "not seen";
    case LinkStatus::not_observed:
      return "not observed";
  }
  return "";
}

std::string fate_text(PixelFate fate) {
  switch (fate) {
    case PixelFate::obstacle:
      return "kept: obstacle";
    case PixelFate::no_reading:
      return "no reading";
    case PixelFate::robot:
      return "robot";
    case PixelFate::padding:
      return "padding of the robot";
    case PixelFate::environment:
      return "environment";
    case PixelFate::flying_patch:
      return "unknown: flying patch";
    case PixelFate::outside_region:
      return "ignored: outside region";
    case PixelFate::soft:
      return "where something soft hangs";
    case PixelFate::speckle:
      return "speckle";
    case PixelFate::background:
      return "kept: background";
    case PixelFate::hole:
      return "hidden: cannot be read any more";
  }
  return "";
}

std::string grouped(std::int64_t count) {
  std::string digits = fmt::format("{}", count);
  for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
  return digits;
}

std::string fit_text(const PictureCanvas& canvas, const std::string& text, const Font& font,
                     double width_px) {
  if (canvas.text_width_px(text, font) <= width_px) return text;
  const std::vector<std::string> points = code_points(text);
  for (std::size_t kept = points.size(); kept-- > 1;) {
    std::string shorter;
    for (std::size_t i = 0; i < (kept + 1) / 2; ++i) shorter += points[i];
    shorter += "…";
    for (std::size_t i = points.size() - kept / 2; i < points.size(); ++i) shorter += points[i];
    if (canvas.text_width_px(shorter, font) <= width_px) return shorter;
  }
  return "…";
}

}  // namespace berth::app
