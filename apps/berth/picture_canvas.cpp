#include "apps/berth/picture_canvas.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <cstring>
#include <numbers>
#include <stdexcept>

namespace berth::app {
namespace {

constexpr double kPi = std::numbers::pi;
// Half the height of DejaVu Sans' capitals.
constexpr double kCapitalMiddle = 0.365;

void require(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw std::runtime_error(cairo_status_to_string(status));
}

void set_color(cairo_t* context, Rgb c, double alpha) {
  cairo_set_source_rgba(context, c.r / 255.0, c.g / 255.0, c.b / 255.0, alpha);
}

void set_font(cairo_t* context, const Font& font) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, font.size_px);
}

void box_path(cairo_t* context, const BoxPx& box, double radius_px) {
  const double r = std::min({radius_px, box.width / 2, box.height / 2});
  const double left = box.x + r, right = box.x + box.width - r;
  const double top = box.y + r, bottom = box.y + box.height - r;
  cairo_new_sub_path(context);
  cairo_arc(context, right, top, r, -kPi / 2, 0);
  cairo_arc(context, right, bottom, r, 0, kPi / 2);
  cairo_arc(context, left, bottom, r, kPi / 2, kPi);
  cairo_arc(context, left, top, r, kPi, 3 * kPi / 2);
  cairo_close_path(context);
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

}  // namespace

struct PictureCanvas::Cairo {
  Cairo(int width_px, int height_px)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width_px, height_px)),
        context(cairo_create(surface)) {}
  ~Cairo() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
  Cairo(const Cairo&) = delete;
  Cairo& operator=(const Cairo&) = delete;

  cairo_surface_t* surface;
  cairo_t* context;
};

PictureCanvas::PictureCanvas(int width_px, int height_px, Rgb background)
    : cairo_(std::make_unique<Cairo>(width_px, height_px)) {
  require(cairo_status(cairo_->context));
  cairo_set_line_cap(cairo_->context, CAIRO_LINE_CAP_ROUND);
  set_color(cairo_->context, background, 1);
  cairo_paint(cairo_->context);
}

PictureCanvas::~PictureCanvas() = default;

void PictureCanvas::fill_box(const BoxPx& box, Rgb color, double radius_px, double alpha) {
  box_path(cairo_->context, box, radius_px);
  set_color(cairo_->context, color, alpha);
  cairo_fill(cairo_->context);
}

void PictureCanvas::stroke_box(const BoxPx& box, Rgb color, double width_px, double radius_px) {
  box_path(cairo_->context, box, radius_px);
  set_color(cairo_->context, color, 1);
  cairo_set_line_width(cairo_->context, width_px);
  cairo_stroke(cairo_->context);
}

void PictureCanvas::line(PointPx a, PointPx b, Rgb color, double width_px, double alpha) {
  set_color(cairo_->context, color, alpha);
  cairo_set_line_width(cairo_->context, width_px);
  cairo_move_to(cairo_->context, a.x, a.y);
  cairo_line_to(cairo_->context, b.x, b.y);
  cairo_stroke(cairo_->context);
}

void PictureCanvas::disc(PointPx centre, double radius_px, Rgb color, double alpha) {
  set_color(cairo_->context, color, alpha);
  cairo_arc(cairo_->context, centre.x, centre.y, radius_px, 0, 2 * kPi);
  cairo_fill(cairo_->context);
}

void PictureCanvas::ring(PointPx centre, double radius_px, Rgb color, double width_px,
                         double alpha) {
  set_color(cairo_->context, color, alpha);
  cairo_set_line_width(cairo_->context, width_px);
  cairo_arc(cairo_->context, centre.x, centre.y, radius_px, 0, 2 * kPi);
  cairo_stroke(cairo_->context);
}

void PictureCanvas::pixels(PointPx top_left, const Image<std::uint32_t>& pixels) {
  cairo_surface_t* copy =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.width(), pixels.height());
  require(cairo_surface_status(copy));
  const int stride = cairo_image_surface_get_stride(copy);
  for (int y = 0; y < pixels.height(); ++y) {
    std::memcpy(cairo_image_surface_get_data(copy) + static_cast<std::ptrdiff_t>(y) * stride,
                pixels.row(y), sizeof(std::uint32_t) * pixels.width());
  }
  cairo_surface_mark_dirty(copy);
  cairo_set_source_surface(cairo_->context, copy, top_left.x, top_left.y);
  cairo_paint(cairo_->context);
  cairo_surface_destroy(copy);
}

void PictureCanvas::text(PointPx point, const std::string& text, const Font& font, Rgb color,
                         Align align) {
  const double share = align == Align::left ? 0 : align == Align::middle ? 0.5 : 1;
  const double x = share == 0 ? point.x : point.x - share * text_width_px(text, font);
  set_font(cairo_->context, font);
  set_color(cairo_->context, color, 1);
  cairo_move_to(cairo_->context, x, point.y + kCapitalMiddle * font.size_px);
  cairo_show_text(cairo_->context, text.c_str());
  cairo_new_path(cairo_->context);
}

double PictureCanvas::text_width_px(const std::string& text, const Font& font) const {
  set_font(cairo_->context, font);
  cairo_text_extents_t extents{};
  cairo_text_extents(cairo_->context, text.c_str(), &extents);
  return extents.x_advance;
}

std::string PictureCanvas::png() const {
  // The first stroke that fails stops all later ones, so that one look at the end is enough.
  require(cairo_status(cairo_->context));
  cairo_surface_flush(cairo_->surface);
  std::string bytes;
  require(cairo_surface_write_to_png_stream(cairo_->surface, append, &bytes));
  return bytes;
}

}  // namespace berth::app
