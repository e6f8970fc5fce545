#include "apps/berth/picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/berth/picture_canvas.hpp"
#include "apps/berth/picture_layout.hpp"
#include "apps/berth/picture_legend.hpp"
#include "apps/berth/picture_pairs.hpp"
#include "apps/berth/picture_pixels.hpp"
#include "apps/berth/picture_text.hpp"
#include "berth/files/file_bytes.hpp"

namespace berth::app {
namespace {

template <typename AnyImage>
void check_size(const AnyImage& image, const DepthView& sensor, const char* what) {
  if (image.width() == sensor.width && image.height() == sensor.height) return;
  throw std::runtime_error(fmt::format("{} is {}x{}, expected the sensor's {}x{}", what,
                                       image.width(), image.height(), sensor.width, sensor.height));
}

void check_pixel(Pixel p, const DepthView& sensor, LinkId id) {
  if (p == Pixel{}) return;
  if (p.u >= 0 && p.v >= 0 && p.u < sensor.width && p.v < sensor.height) return;
  throw std::runtime_error(
      fmt::format("link {} has the pixel ({}, {}), expected one of the {}x{} image", id, p.u, p.v,
                  sensor.width, sensor.height));
}

void check_links(const PictureInput& input) {
  const std::vector<PictureLink>& links = *input.links;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].id != i + 1)
      throw std::runtime_error(
          fmt::format("link {} of the answer has the id {}", i + 1, links[i].id));
    if (links[i].status != LinkStatus::ok) continue;
    check_pixel(links[i].robot_pixel, input.sensor_depth_m, links[i].id);
    check_pixel(links[i].obstacle_pixel, input.sensor_depth_m, links[i].id);
  }
  if (!(input.range_m > 0))
    throw std::runtime_error(fmt::format("the range is {} m, expected more than 0", input.range_m));
}

void check(const PictureInput& input) {
  const DepthView& sensor = input.sensor_depth_m;
  if (!sensor.data || sensor.width <= 0 || sensor.height <= 0)
    throw std::runtime_error("the depth image has no pixels");
  if (input.robot) {
    check_size(input.robot->depth_m, sensor, "the robot depth image");
    check_size(input.robot->link_id, sensor, "the link ID image");
  }
  if (input.obstacles) check_size(input.obstacles->fate, sensor, "the image of fates");
  if (input.links) check_links(input);
}

std::string draw(const PictureInput& input) {
  check(input);
  const PictureLayout layout = layout_picture(input);
  const DepthTone tone = depth_tone(input.sensor_depth_m);
  const int line_px = std::max(1, static_cast<int>(std::lround(layout.em_px / 10)));
  PictureCanvas canvas(layout.width_px, layout.height_px, kPaper);

  const Font title_font{1.2 * layout.em_px, true};
  canvas.text({layout.title.x, layout.title.height / 2},
              fit_text(canvas, input.title, title_font, layout.title.width), title_font, kInk);
  canvas.pixels({layout.image.x, layout.image.y},
                paint_pixels(input, tone, layout.factor, line_px));
  if (input.links) draw_pairs(canvas, layout, input);
  draw_legend(canvas, layout, input, tone);
  return canvas.png();
}

}  // namespace

void write_picture(const std::filesystem::path& path, const PictureInput& input) {
  std::string png;
  try {
    png = draw(input);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(
        fmt::format("{}: cannot draw the picture: {}", path.string(), error.what()));
  }
  write_file_bytes(path, png);
}

}  // namespace berth::app
