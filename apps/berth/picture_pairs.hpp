// Each link's closest pair, drawn on the image.
#pragma once

#include <optional>
#include <vector>

#include "apps/berth/picture.hpp"
#include "apps/berth/picture_canvas.hpp"
#include "apps/berth/picture_layout.hpp"

namespace berth::app {

/// A label that belongs near `anchor`.
struct LabelRequest {
  PointPx anchor;
  double width_px = 0;
  double height_px = 0;
};

/// One box for each request, in their order, earlier ones first served: inside `bounds`, never over
/// another label, near its anchor and, where it can, beside the points of `avoid`. None where no
/// place is free.
std::vector<std::optional<BoxPx>> place_labels(const std::vector<LabelRequest>& requests,
                                               const BoxPx& bounds,
                                               const std::vector<PointPx>& avoid);

/// Dashed where no camera sees the obstacle's point.
void draw_pair_line(PictureCanvas& canvas, PointPx from, PointPx to, bool dashed, Rgb color,
                    double width_px, double alpha);

/// The end of a pair on the robot and the one on the obstacle.
void draw_robot_end(PictureCanvas& canvas, PointPx centre, Rgb color, double em_px);
void draw_obstacle_end(PictureCanvas& canvas, PointPx centre, Rgb color, double em_px);

/// For each link with a distance: a line from its robot pixel to its obstacle pixel, and the
/// distance beside it. The nearest link comes last, on top of the others.
void draw_pairs(PictureCanvas& canvas, const PictureLayout& layout, const PictureInput& input);

}  // namespace berth::app
