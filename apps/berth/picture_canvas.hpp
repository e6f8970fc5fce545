// A sheet to draw on: cairo, with the few strokes that the picture needs. Lengths are in its
// pixels, y down.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/berth/picture_palette.hpp"
#include "berth/types/image.hpp"

namespace berth::app {

struct PointPx {
  double x = 0;
  double y = 0;
};

struct BoxPx {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};

struct Font {
  double size_px = 0;
  bool bold = false;
};

/// Which part of the text stands at the point given.
enum class Align { left, middle, right };

class PictureCanvas {
 public:
  PictureCanvas(int width_px, int height_px, Rgb background);
  ~PictureCanvas();
  PictureCanvas(const PictureCanvas&) = delete;
  PictureCanvas& operator=(const PictureCanvas&) = delete;

  void fill_box(const BoxPx& box, Rgb color, double radius_px = 0, double alpha = 1);
  void stroke_box(const BoxPx& box, Rgb color, double width_px, double radius_px = 0);
  void line(PointPx a, PointPx b, Rgb color, double width_px, double alpha = 1);
  void disc(PointPx centre, double radius_px, Rgb color, double alpha = 1);
  void ring(PointPx centre, double radius_px, Rgb color, double width_px, double alpha = 1);
  /// `pixels` are 0x00RRGGBB.
  void pixels(PointPx top_left, const Image<std::uint32_t>& pixels);

  /// One line of UTF-8; point.y is the height of the capitals' middle.
  void text(PointPx point, const std::string& text, const Font& font, Rgb color,
            Align align = Align::left);
  double text_width_px(const std::string& text, const Font& font) const;

  /// The bytes of a PNG file. Throws std::runtime_error where anything could not be drawn.
  std::string png() const;

 private:
  struct Cairo;
  std::unique_ptr<Cairo> cairo_;
};

}  // namespace berth::app
