#include "sim/whole_robot_points.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/plain_aging.hpp"
#include "sim/plain_closing.hpp"
#include "sim/plain_hiding.hpp"

namespace berth::sim {
namespace {

/// The own free depth of a pixel that frees nothing.
constexpr float kNone = 0;

/// What a pixel with a reading, or with something that a sensor rule put there, frees by itself.
/// Floats, as the images are: what is rounded down may hang on a last bit.
float own_of_reading(const PointView& view, const SpaceSettings& settings, int u, int v) {
  const float sensed_m = view.sensor_depth_m(u, v);
  const float obstacle_m = view.obstacle_depth_m(u, v);
  const auto margin_m = static_cast<float>(settings.free_space_margin_m);
  const auto behind_m = static_cast<float>(settings.behind_robot_m);
  switch (view.fate(u, v)) {
    case PixelFate::background:
      if (std::isnan(sensed_m)) return kNone;
      return std::min(obstacle_m - margin_m, sensed_m + behind_m);
    case PixelFate::environment: {
      float freed_m = sensed_m - margin_m;
      if (view.environment_back_m.pixels().empty()) return freed_m;
      const float back_m = view.environment_back_m(u, v);
      const float solid_m = back_m > sensed_m + behind_m ? sensed_m + behind_m : back_m;
      if (solid_m > freed_m) freed_m = solid_m;
      return freed_m;
    }
    case PixelFate::robot:
    case PixelFate::padding:
      return sensed_m + behind_m;
    case PixelFate::flying_patch:
    case PixelFate::soft:
    case PixelFate::speckle:
    case PixelFate::outside_region:
      return sensed_m - margin_m;
    case PixelFate::obstacle:
    case PixelFate::hole:
    case PixelFate::no_reading:
      break;
  }
  return obstacle_m - margin_m;
}

bool is_empty(const PointView& view, int u, int v) {
  if (view.fate(u, v) == PixelFate::hole) return true;
  return std::isnan(view.sensor_depth_m(u, v)) && std::isnan(view.obstacle_depth_m(u, v));
}

DepthImage own_free_depth_m(const PointView& view, const SpaceSettings& settings) {
  const int width = view.camera.width_px;
  const int height = view.camera.height_px;
  DepthImage own_m(width, height, kNone);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const float of_hole_m = settings.no_reading == NoReading::free ? HUGE_VALF : kNone;
      const float freed_m = is_empty(view, u, v) ? of_hole_m : own_of_reading(view, settings, u, v);
      if (freed_m > 0) own_m(u, v) = plainly_counted(freed_m);
    }
  }
  const double told_m = plainly_told_m(settings, view.camera);
  own_m = plainly_freed_beside_robot(view.camera, view.sensor_depth_m, view.obstacle_depth_m,
                                     view.fate, own_m, told_m);
  return plainly_closed(view.camera, own_m, told_m);
}

}  // namespace

Image<double> free_depth_m(const PointView& view, const SpaceSettings& settings) {
  Image<double> free_m(view.camera.width_px, view.camera.height_px, kNone);
  if (view.age_s > kYoung_s) return free_m;
  const DepthImage aged_m =
      plainly_aged(view.camera, view.sensor_depth_m, own_free_depth_m(view, settings),
                   view.environment_front_m, settings.obstacle_speed_m_s * view.age_s);
  std::ranges::copy(aged_m.pixels(), free_m.pixels().begin());
  return free_m;
}

Pixel plain_pixel_of(const Camera& camera, const Eigen::Vector3d& p_C) {
  if (!(p_C.z() > 0)) return {};
  const double u = std::round(camera.fx_px * p_C.x() / p_C.z() + camera.cx_px);
  const double v = std::round(camera.fy_px * p_C.y() / p_C.z() + camera.cy_px);
  if (!(u >= 0 && v >= 0 && u < camera.width_px && v < camera.height_px)) return {};
  return {static_cast<int>(u), static_cast<int>(v)};
}

PointSpace::PointSpace(std::vector<PointView> views, const SpaceSettings& settings)
    : views_(std::move(views)), settings_(settings) {
  for (const PointView& view : views_) {
    free_depth_m_.push_back(free_depth_m(view, settings));
    hidden_from_m_.push_back(plainly_hidden_from(view.camera, view.sensor_depth_m,
                                                 view.obstacle_depth_m, view.fate,
                                                 own_free_depth_m(view, settings), settings));
  }
}

double PointSpace::hidden_to_m(std::size_t k, Pixel pixel) const {
  return plainly_hidden_to(views_[k].environment_front_m, pixel);
}

bool PointSpace::is_reading(std::size_t k, const Eigen::Vector3d& p_B) const {
  const Eigen::Vector3d p_C = views_[k].X_BC.inverse() * p_B;
  const Pixel pixel = plain_pixel_of(views_[k].camera, p_C);
  if (pixel == Pixel{}) return false;
  const double near_m = views_[k].obstacle_depth_m(pixel.u, pixel.v);
  return near_m <= p_C.z() && p_C.z() <= near_m + settings_.surface_thickness_m;
}

bool PointSpace::is_behind(std::size_t k, const Eigen::Vector3d& p_B) const {
  const Eigen::Vector3d p_C = views_[k].X_BC.inverse() * p_B;
  const Pixel pixel = plain_pixel_of(views_[k].camera, p_C);
  if (pixel == Pixel{}) return false;
  return p_C.z() > hidden_from_m_[k](pixel.u, pixel.v) && p_C.z() < hidden_to_m(k, pixel);
}

bool PointSpace::is_free(std::size_t k, const Eigen::Vector3d& p_B) const {
  const Eigen::Vector3d p_C = views_[k].X_BC.inverse() * p_B;
  const Pixel pixel = plain_pixel_of(views_[k].camera, p_C);
  return pixel != Pixel{} && p_C.z() < free_depth_m_[k](pixel.u, pixel.v);
}

bool PointSpace::is_reading(const Eigen::Vector3d& p_B) const {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    if (is_reading(k, p_B)) return true;
  }
  return false;
}

bool PointSpace::is_unobserved(const Eigen::Vector3d& p_B) const {
  if (settings_.unobserved != Unobserved::unknown || views_.empty()) return false;
  for (std::size_t k = 0; k < views_.size(); ++k) {
    const Pixel pixel = plain_pixel_of(views_[k].camera, views_[k].X_BC.inverse() * p_B);
    if (is_young(k) && pixel != Pixel{}) return false;
  }
  return true;
}

bool PointSpace::is_hidden(const Eigen::Vector3d& p_B) const {
  for (std::size_t k = 0; k < views_.size(); ++k) {
    if (!is_behind(k, p_B)) continue;
    bool is_seen_free = false;
    for (std::size_t j = 0; j < views_.size(); ++j) {
      if (j != k && is_free(j, p_B)) is_seen_free = true;
    }
    if (!is_seen_free) return true;
  }
  return is_unobserved(p_B);
}

}  // namespace berth::sim
