#include "apps/berth/picture_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/berth/picture_text.hpp"

namespace berth::app {
namespace {

constexpr double kLineEm = 0.16;

struct Pair {
  PointPx robot;
  PointPx obstacle;
  Rgb color;
  std::string text;
  bool nearest = false;
  bool contact = false;
  /// No camera sees the obstacle's point.
  bool hidden = false;

  PointPx middle() const { return {(robot.x + obstacle.x) / 2, (robot.y + obstacle.y) / 2}; }
};

bool is_drawn(const PictureLink& link) {
  return link.status == LinkStatus::ok && link.robot_pixel != Pixel{} &&
         link.obstacle_pixel != Pixel{};
}

std::vector<Pair> nearest_first(const PictureLayout& layout, const PictureInput& input) {
  std::vector<PictureLink> links;
  for (const PictureLink& link : *input.links)
    if (is_drawn(link)) links.push_back(link);
  std::stable_sort(links.begin(), links.end(), [&](const auto& a, const auto& b) {
    // One that stands on its table does not lead.
    return std::pair(!a.is_moved, a.distance_m) < std::pair(!b.is_moved, b.distance_m);
  });
  std::vector<Pair> pairs;
  for (const PictureLink& link : links) {
    pairs.push_back({layout.centre(link.robot_pixel), layout.centre(link.obstacle_pixel),
                     link_color(link.id), distance_text(link, input.range_m), pairs.empty(),
                     is_contact(link), link.obstacle_is != ObstacleKind::occupied});
  }
  return pairs;
}

/// What labels should not hide: the pairs, most of all their ends, and the robot.
std::vector<PointPx> precious_points(const std::vector<Pair>& pairs, const PictureLayout& layout,
                                     const PictureInput& input) {
  constexpr int kWeightOfEnd = 4;
  std::vector<PointPx> points;
  for (const Pair& pair : pairs) {
    points.insert(points.end(), kWeightOfEnd, pair.robot);
    points.insert(points.end(), kWeightOfEnd, pair.obstacle);
    const double dx = pair.obstacle.x - pair.robot.x, dy = pair.obstacle.y - pair.robot.y;
    const int steps = 1 + static_cast<int>(std::hypot(dx, dy) / (0.8 * layout.em_px));
    for (int k = 1; k < steps; ++k)
      points.push_back({pair.robot.x + dx * k / steps, pair.robot.y + dy * k / steps});
  }
  if (!input.robot) return points;
  const int spacing = std::max(1, static_cast<int>(layout.em_px / layout.factor));
  for (int v = 0; v < input.sensor_depth_m.height; v += spacing) {
    for (int u = 0; u < input.sensor_depth_m.width; u += spacing) {
      const LinkId id = input.robot->link_id(u, v);
      if (id != kNoLink && id != kEnvironmentLink) points.push_back(layout.centre({u, v}));
    }
  }
  return points;
}

void draw_pair(PictureCanvas& canvas, const Pair& pair, double em) {
  const double width = kLineEm * em * (pair.nearest ? 1.5 : 1);
  draw_pair_line(canvas, pair.robot, pair.obstacle, pair.hidden, kBlack, width + 0.22 * em, 0.75);
  draw_pair_line(canvas, pair.robot, pair.obstacle, pair.hidden, pair.color, width, 1);
  if (pair.contact) {
    canvas.ring(pair.middle(), 0.95 * em, kBlack, 0.42 * em, 0.75);
    canvas.ring(pair.middle(), 0.95 * em, kWhite, 0.2 * em);
  }
  draw_obstacle_end(canvas, pair.obstacle, pair.color, em);
  draw_robot_end(canvas, pair.robot, pair.color, em);
}

PointPx closest_point(const BoxPx& box, PointPx p) {
  return {std::clamp(p.x, box.x, box.x + box.width), std::clamp(p.y, box.y, box.y + box.height)};
}

Font label_font(const Pair& pair, double em) {
  return {pair.nearest ? 1.1 * em : 0.85 * em, pair.nearest};
}

void draw_leader(PictureCanvas& canvas, const Pair& pair, const BoxPx& box, double em) {
  const PointPx end = closest_point(box, pair.middle());
  canvas.line(pair.middle(), end, kBlack, 0.2 * em, 0.6);
  canvas.line(pair.middle(), end, mix(pair.color, kWhite, 0.35), 0.07 * em);
}

void draw_label(PictureCanvas& canvas, const Pair& pair, const BoxPx& box, double em) {
  canvas.fill_box(box, {0x0C, 0x0E, 0x12}, 0.3 * em, 0.84);
  canvas.stroke_box(box, pair.nearest ? kWhite : pair.color, 0.09 * em, 0.3 * em);
  canvas.text({box.x + box.width / 2, box.y + box.height / 2}, pair.text, label_font(pair, em),
              kWhite, Align::middle);
}

}  // namespace

void draw_pair_line(PictureCanvas& canvas, PointPx from, PointPx to, bool dashed, Rgb color,
                    double width_px, double alpha) {
  if (!dashed) return canvas.line(from, to, color, width_px, alpha);
  constexpr double kDashPx = 7;
  const double length_px = std::hypot(to.x - from.x, to.y - from.y);
  const auto at = [&](double px) {
    const double share = std::min(1.0, px / length_px);
    return PointPx{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
  };
  for (double px = 0; px < length_px; px += 2 * kDashPx) {
    canvas.line(at(px), at(px + kDashPx), color, width_px, alpha);
  }
}

void draw_robot_end(PictureCanvas& canvas, PointPx centre, Rgb color, double em_px) {
  canvas.disc(centre, 0.44 * em_px, kBlack, 0.8);
  canvas.disc(centre, 0.34 * em_px, kWhite);
  canvas.disc(centre, 0.24 * em_px, color);
}

void draw_obstacle_end(PictureCanvas& canvas, PointPx centre, Rgb color, double em_px) {
  canvas.ring(centre, 0.38 * em_px, kBlack, 0.36 * em_px, 0.8);
  canvas.ring(centre, 0.38 * em_px, color, 0.18 * em_px);
}

void draw_pairs(PictureCanvas& canvas, const PictureLayout& layout, const PictureInput& input) {
  const std::vector<Pair> pairs = nearest_first(layout, input);
  // Many lines get finer ones, or they would hide the image.
  const double em = layout.em_px * (pairs.size() > 16 ? 0.75 : 1);
  std::vector<LabelRequest> requests;
  for (const Pair& pair : pairs) {
    const Font font = label_font(pair, em);
    requests.push_back({pair.middle(), canvas.text_width_px(pair.text, font) + 0.9 * font.size_px,
                        1.65 * font.size_px});
  }
  const auto boxes = place_labels(requests, layout.image, precious_points(pairs, layout, input));
  for (std::size_t i = pairs.size(); i-- > 0;)
    if (boxes[i]) draw_leader(canvas, pairs[i], *boxes[i], em);
  for (std::size_t i = pairs.size(); i-- > 0;) draw_pair(canvas, pairs[i], em);
  for (std::size_t i = pairs.size(); i-- > 0;)
    if (boxes[i]) draw_label(canvas, pairs[i], *boxes[i], em);
}

}  // namespace berth::app
