#include "berth/sensor/rectification.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace berth {

/// The rays of a lens: a point of the plane at depth 1, as a pinhole shows it, and as the lens
/// does. Formulas of OpenCV's calib3d and fisheye modules, without prisms and tilt.
class LensRays {
 public:
  explicit LensRays(const std::optional<Lens>& lens) : lens_(lens.value_or(Lens{})) {
    // Farther out many polynomials turn back, and a point of the image would have two rays.
    while (radius_.size() * kStep_rad < kWidest_rad) {
      const double bent = bent_radius(std::tan(radius_.size() * kStep_rad));
      if (!radius_.empty() && !(bent > radius_.back())) break;
      radius_.push_back(bent);
    }
  }

  Eigen::Vector2d bent(const Eigen::Vector2d& ray) const {
    const double r = ray.norm();
    if (r == 0) return ray;
    const Eigen::Vector2d radial = ray * (bent_radius(r) / r);
    if (lens_.is_fisheye) return radial;
    const double p1 = lens_.coefficients[2], p2 = lens_.coefficients[3];
    const double x = ray.x(), y = ray.y();
    return radial + Eigen::Vector2d(2 * p1 * x * y + p2 * (r * r + 2 * x * x),
                                    p1 * (r * r + 2 * y * y) + 2 * p2 * x * y);
  }

  /// The other way; none where no ray goes.
  std::optional<Eigen::Vector2d> straight(const Eigen::Vector2d& point) const {
    Eigen::Vector2d radial = point;
    std::optional<Eigen::Vector2d> ray;
    // The part that is not radial is small: each turn leaves a hundredth of the error.
    for (int turn = 0; turn < 8; ++turn) {
      ray = straight_radial(radial);
      if (!ray) return ray;
      radial += point - bent(*ray);
    }
    return ray;
  }

  bool sees(const Eigen::Vector2d& ray) const { return ray.norm() <= widest(); }

 private:
  static constexpr double kStep_rad = 0.002;
  static constexpr double kWidest_rad = 75 * std::numbers::pi / 180;

  double widest() const { return std::tan((static_cast<double>(radius_.size()) - 1) * kStep_rad); }

  double bent_radius(double r) const {
    const auto& k = lens_.coefficients;
    if (lens_.is_fisheye) {
      const double a = std::atan(r), a2 = a * a;
      return a * (1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
    }
    const double r2 = r * r;
    return r * (1 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
           (1 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
  }

  std::optional<Eigen::Vector2d> straight_radial(const Eigen::Vector2d& point) const {
    const double wanted = point.norm();
    if (wanted == 0) return point;
    const auto above = std::ranges::upper_bound(radius_, wanted);
    if (above == radius_.end()) {
      // A polynomial that turns back was fitted to less than the image: its last ray is the nearest
      // to the truth.
      if (radius_.size() * kStep_rad >= kWidest_rad) return {};
      return point * (widest() / wanted);
    }
    double low = std::tan(static_cast<double>(above - radius_.begin() - 1) * kStep_rad);
    double high = std::tan(static_cast<double>(above - radius_.begin()) * kStep_rad);
    for (int half = 0; half < 30; ++half) {
      const double middle = (low + high) / 2;
      (bent_radius(middle) > wanted ? high : low) = middle;
    }
    return point * (low / wanted);
  }

  Lens lens_;
  /// How far from the middle what lies kStep_rad, twice that, ... from the axis is shown.
  std::vector<double> radius_;
};

namespace {

constexpr double kMostPixels = 4;

Eigen::Vector2d plane_point(const Camera& camera, double u, double v) {
  return {(u - camera.cx_px) / camera.fx_px, (v - camera.cy_px) / camera.fy_px};
}

std::optional<std::int32_t> pixel_at(const Camera& camera, const Eigen::Vector2d& point) {
  const std::optional<Pixel> at = pixel_of(camera, point.homogeneous());
  return at ? std::optional(at->v * camera.width_px + at->u) : std::nullopt;
}

template <class Visit>
void visit_pixels(const Camera& camera, const Visit& visit) {
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      visit(plane_point(camera, u, v), v * camera.width_px + u);
    }
  }
}

}  // namespace

Rectification::Rectification(const Camera& given, const std::optional<Lens>& lens, DepthIs depth_is)
    : given_(given), lens_(lens), camera_(given), depth_is_(depth_is) {
  const LensRays rays(lens);
  if (lens) find_camera(rays);
  find_pixels(rays);
}

void Rectification::find_camera(const LensRays& rays) {
  Eigen::AlignedBox2d seen;
  visit_pixels(given_, [&](const Eigen::Vector2d& point, std::int32_t) {
    if (const auto ray = rays.straight(point)) seen.extend(*ray);
  });
  const Eigen::Array2d f(given_.fx_px, given_.fy_px);
  const double pixels = (seen.sizes().array() * f).prod();
  const double most = kMostPixels * given_.width_px * given_.height_px;
  const Eigen::Array2d scaled = f * std::min(1.0, std::sqrt(most / pixels));
  camera_.fx_px = scaled.x();
  camera_.fy_px = scaled.y();
  camera_.cx_px = -seen.min().x() * scaled.x();
  camera_.cy_px = -seen.min().y() * scaled.y();
  camera_.width_px = static_cast<int>(std::lround(seen.sizes().x() * scaled.x())) + 1;
  camera_.height_px = static_cast<int>(std::lround(seen.sizes().y() * scaled.y())) + 1;
}

void Rectification::find_pixels(const LensRays& rays) {
  std::vector<bool> is_taken(static_cast<std::size_t>(given_.width_px) * given_.height_px);
  visit_pixels(camera_, [&](const Eigen::Vector2d& ray, std::int32_t) {
    const auto from = rays.sees(ray) ? pixel_at(given_, rays.bent(ray)) : std::nullopt;
    from_.push_back(from.value_or(-1));
    if (from) is_taken[*from] = true;
  });
  visit_pixels(given_, [&](const Eigen::Vector2d& point, std::int32_t pixel) {
    const auto ray = is_taken[pixel] ? std::nullopt : rays.straight(point);
    if (!ray) return;
    if (const auto to = pixel_at(camera_, *ray)) more_.emplace_back(pixel, *to);
  });
}

void Rectification::apply(DepthView given_m, DepthImage& made_m) const {
  assert(given_m.width == given_.width_px && given_m.height == given_.height_px);
  const auto reading_m = [&](std::int32_t pixel) {
    return given_m.row(pixel / given_.width_px)[pixel % given_.width_px];
  };
  made_m.resize(camera_.width_px, camera_.height_px, kNoDepth);
  std::ranges::transform(from_, made_m.pixels().begin(),
                         [&](std::int32_t from) { return from < 0 ? kNoDepth : reading_m(from); });
  for (const auto& [from, to] : more_) {
    float& told_m = made_m.pixels()[to];
    told_m = std::fmin(told_m, reading_m(from));
  }
  if (depth_is_ == DepthIs::along_axis) return;
  visit_pixels(camera_, [&](const Eigen::Vector2d& ray, std::int32_t pixel) {
    made_m.pixels()[pixel] /= static_cast<float>(ray.homogeneous().norm());
  });
}

DepthImage Rectification::apply(DepthView given_m) const {
  DepthImage made_m;
  apply(given_m, made_m);
  return made_m;
}

}  // namespace berth
