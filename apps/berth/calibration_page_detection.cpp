#include "apps/berth/calibration_page_parts.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>

#include "apps/berth/html_text.hpp"
#include "berth/reports/calibration_words.hpp"

namespace berth::app {
namespace {

using Html = std::back_insert_iterator<std::string>;

struct Shade {
  double most_m;
  const char* color;
  const char* text;
};
constexpr Shade kShades[] = {{0.02, "#1b7f4d", "20 mm and less"},
                             {0.04, "#8fce6a", "up to 40 mm"},
                             {0.08, "#f0a030", "up to 80 mm"},
                             {HUGE_VAL, "#c8322d", "not even 80 mm"}};
constexpr const char* kNotInView = "#9aa3ad55";

const char* color_of(double least_m) {
  for (const Shade& shade : kShades) {
    if (least_m <= shade.most_m) return shade.color;
  }
  return kNotInView;
}

/// Seen from above, x to the right and y upwards.
void add_slice(const DetectionMap& map, double z_m, const std::vector<std::size_t>& places,
               Html out) {
  const double half_m = map.reach.radius_m + map.step_m;
  const Eigen::Vector3d& center_m = map.reach.center_B_m;
  fmt::format_to(out,
                 "<figure><svg viewBox=\"{:.4f} {:.4f} {:.4f} {:.4f}\" role=\"img\" "
                 "aria-label=\"places {:.2f} m high\">",
                 center_m.x() - half_m, -center_m.y() - half_m, 2 * half_m, 2 * half_m, z_m);
  for (const std::size_t i : places) {
    const Eigen::Vector3d& at_m = map.places_B_m[i];
    fmt::format_to(
        out, "<rect x=\"{:.4f}\" y=\"{:.4f}\" width=\"{:.4f}\" height=\"{:.4f}\" fill=\"{}\"/>",
        at_m.x() - map.step_m / 2, -at_m.y() - map.step_m / 2, 0.94 * map.step_m, 0.94 * map.step_m,
        color_of(map.cell.least_m[i]));
  }
  fmt::format_to(out, "</svg><figcaption>z = {:.2f} m</figcaption></figure>", z_m + 0.0);
}

void add_key(const char* color, const char* text, Html out) {
  fmt::format_to(out, "<span><i class=\"key\" style=\"background: {}\"></i>{}</span>", color, text);
}

}  // namespace

std::string detection_section(const DetectionMap& map) {
  if (map.empty()) return "";
  std::string html = "<section>\n<h2>What the cameras detect</h2>\n";
  const auto out = std::back_inserter(html);
  for (const std::string& sentence : detection_texts(map)) {
    fmt::format_to(out, "<p>{}</p>\n", html_text(sentence));
  }
  fmt::format_to(out,
                 "<p class=\"faint keys\">The least ball that is detected, in slices through "
                 "the reach, seen from above (x to the right, y upwards): ");
  for (const Shade& shade : kShades) add_key(shade.color, shade.text, out);
  add_key(kNotInView, "no camera has it in view", out);
  fmt::format_to(out, "</p>\n<div class=\"slices\">");
  std::map<long, std::vector<std::size_t>> slices;
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    const double off_m = map.places_B_m[i].z() - map.reach.center_B_m.z();
    slices[std::lround(off_m / map.step_m)].push_back(i);
  }
  for (const auto& [layer, places] : slices) {
    add_slice(map, map.places_B_m[places.front()].z(), places, out);
  }
  fmt::format_to(out, "</div>\n</section>\n");
  return html;
}

}  // namespace berth::app
