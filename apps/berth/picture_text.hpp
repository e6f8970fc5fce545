// The words and numbers of the picture.
#pragma once

#include <cstdint>
#include <string>

#include "apps/berth/picture_canvas.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/types/obstacle_image.hpp"

namespace berth::app {

/// "1.00 m"; a third decimal where the second would round.
std::string range_text(double range_m);

/// Whether the distance is 0 to something that a camera measured.
bool is_contact(const LinkResult& link);

/// "0.137 m", or "contact", or "unknown 0 m, seen 0.520 m" where only unknown space touches, or why
/// there is no distance.
std::string distance_text(const LinkResult& link, double range_m);
/// The same, but "unknown 0 m" alone.
std::string short_distance_text(const LinkResult& link, double range_m);

std::string fate_text(PixelFate fate);

/// 1234567 as "1,234,567".
std::string grouped(std::int64_t count);

/// The text, or its two ends around an ellipsis so that it is not wider than width_px.
std::string fit_text(const PictureCanvas& canvas, const std::string& text, const Font& font,
                     double width_px);

}  // namespace berth::app
