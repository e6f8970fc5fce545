#include "apps/berth/picture_pixels.hpp"

#include <algorithm>
#include <cmath>

namespace berth::app {
namespace {

constexpr double kDarkest = 66;
constexpr double kBrightest = 228;

bool has_reading(float depth_m) { return std::isfinite(depth_m) && depth_m > 0; }

bool is_link(LinkId id) { return id != kNoLink && id != kEnvironmentLink; }

LinkId link_at(const PictureInput& input, int u, int v) {
  return input.robot ? input.robot->link_id(u, v) : kNoLink;
}

PixelFate fate_at(const PictureInput& input, int u, int v) {
  if (input.obstacles) return input.obstacles->fate(u, v);
  if (!has_reading(input.sensor_depth_m(u, v))) return PixelFate::no_reading;
  const LinkId id = link_at(input, u, v);
  if (id == kEnvironmentLink) return PixelFate::environment;
  return id == kNoLink ? PixelFate::obstacle : PixelFate::robot;
}

/// Change of the robot's depth in one direction, per pixel, from neighbours on the same link.
double slope_m(const RobotImage& robot, int u, int v, int du, int dv) {
  constexpr int kReach = 3;  // far enough to even out depth that came in whole millimetres
  const LinkId id = robot.link_id(u, v);
  const auto depth = [&](int step) -> double {
    const int u2 = u + step * du, v2 = v + step * dv;
    const bool inside =
        u2 >= 0 && v2 >= 0 && u2 < robot.depth_m.width() && v2 < robot.depth_m.height();
    return inside && robot.link_id(u2, v2) == id ? robot.depth_m(u2, v2) : kNoDepth;
  };
  int ahead = kReach, behind = kReach;
  while (ahead > 0 && std::isnan(depth(ahead))) --ahead;
  while (behind > 0 && std::isnan(depth(-behind))) --behind;
  return ahead + behind == 0 ? 0 : (depth(ahead) - depth(-behind)) / (ahead + behind);
}

/// Brightness as from a lamp at the camera; the focal length is guessed, which only changes the
/// contrast.
double lamp(const RobotImage& robot, int u, int v) {
  if (!has_reading(robot.depth_m(u, v))) return 1;
  const double px_per_m = 0.9 * robot.depth_m.width() / robot.depth_m(u, v);
  const double slope =
      px_per_m * std::hypot(slope_m(robot, u, v, 1, 0), slope_m(robot, u, v, 0, 1));
  return 1 / std::sqrt(1 + slope * slope);
}

Rgb pixel_color(const PictureInput& input, const DepthTone& tone, int u, int v) {
  const PixelFate fate = fate_at(input, u, v);
  const LinkId id = link_at(input, u, v);
  const bool is_added = fate == PixelFate::background || fate == PixelFate::hole;
  const float depth_m = is_added ? input.obstacles->depth_m(u, v) : input.sensor_depth_m(u, v);
  const Rgb grey = has_reading(depth_m) ? tone(depth_m) : fate_color(PixelFate::no_reading);
  if (is_link(id)) {
    const Rgb lit =
        mix(mix(link_color(id), kBlack, 0.55), link_color(id), lamp(*input.robot, u, v));
    return is_kept(fate) && !is_added ? mix(grey, lit, 0.3) : lit;
  }
  const bool plain = fate == PixelFate::obstacle || fate == PixelFate::no_reading;
  return plain ? grey : mix(grey, fate_color(fate), 0.5);
}

bool is_hatched(const PictureInput& input, int u, int v) {
  return fate_at(input, u, v) == PixelFate::no_reading && !is_link(link_at(input, u, v));
}

std::uint32_t packed(Rgb c) {
  return static_cast<std::uint32_t>(c.r) << 16 | static_cast<std::uint32_t>(c.g) << 8 | c.b;
}

}  // namespace

Rgb DepthTone::operator()(double depth_m) const {
  const double span = std::log(far_m / near_m);
  const double nearness = span > 0 ? std::clamp(std::log(far_m / depth_m) / span, 0.0, 1.0) : 1;
  const auto grey = static_cast<std::uint8_t>(kDarkest + (kBrightest - kDarkest) * nearness);
  return {grey, grey, grey};
}

DepthTone depth_tone(const DepthView& depth_m) {
  std::vector<float> sample;
  const int step = std::max(1, static_cast<int>(std::hypot(depth_m.width, depth_m.height) / 450));
  for (int v = 0; v < depth_m.height; v += step) {
    for (int u = 0; u < depth_m.width; u += step) {
      const float z = depth_m(u, v);
      if (has_reading(z)) sample.push_back(z);
    }
  }
  if (sample.empty()) return {};
  std::sort(sample.begin(), sample.end());
  return {sample[sample.size() / 100], sample[sample.size() - 1 - sample.size() / 100]};
}

Rgb hatch(int x, int y, int stripe_px) {
  const Rgb ground = fate_color(PixelFate::no_reading);
  return (x + y) / stripe_px % 5 == 0 ? mix(ground, kWhite, 0.14) : ground;
}

Image<std::uint32_t> paint_pixels(const PictureInput& input, const DepthTone& tone, int factor,
                                  int line_px) {
  const int width = input.sensor_depth_m.width, height = input.sensor_depth_m.height;
  Image<std::uint32_t> picture(width * factor, height * factor);
  Image<Rgb> colors(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) colors(u, v) = pixel_color(input, tone, u, v);

  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const int u = x / factor, v = y / factor;
      const LinkId id = link_at(input, u, v);
      const LinkId right = link_at(input, std::min(x + line_px, picture.width() - 1) / factor, v);
      const LinkId below = link_at(input, u, std::min(y + line_px, picture.height() - 1) / factor);
      const bool outline = (right != id && (is_link(id) || is_link(right))) ||
                           (below != id && (is_link(id) || is_link(below)));
      const Rgb color = is_hatched(input, u, v) ? hatch(x, y, line_px) : colors(u, v);
      picture(x, y) = packed(outline ? mix(color, kBlack, 0.6) : color);
    }
  }
  return picture;
}

}  // namespace berth::app
