#include "tests/self_filter/plain_definition.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace berth {
namespace {

class PlainFilter {
 public:
  PlainFilter(const Camera& camera, const DepthImage& sensor_depth_m, const RobotImage& robot,
              const SelfFilterSettings& settings)
      : camera_(camera), sensor_(sensor_depth_m), robot_(robot), settings_(settings) {
    fate_ = Image<PixelFate>(camera.width_px, camera.height_px, PixelFate::obstacle);
    for_each([&](int u, int v) {
      if (is_outline(u, v)) outline_.push_back({u, v});
    });
  }

  ObstacleImage run() {
    for_each([&](int u, int v) { fate_(u, v) = fate_alone(u, v); });
    if (settings_.flying_patch_radius_m > 0) drop_flying_patches();
    ObstacleImage out;
    out.fate = fate_;
    out.depth_m = DepthImage(camera_.width_px, camera_.height_px, kNoDepth);
    for_each([&](int u, int v) {
      ++out.count[static_cast<std::size_t>(fate_(u, v))];
      if (fate_(u, v) == PixelFate::obstacle) out.depth_m(u, v) = sensor_(u, v);
    });
    return out;
  }

 private:
  template <class Call>
  void for_each(const Call& call) const {
    for (int v = 0; v < camera_.height_px; ++v) {
      for (int u = 0; u < camera_.width_px; ++u) call(u, v);
    }
  }

  bool is_inside(int u, int v) const {
    return u >= 0 && v >= 0 && u < camera_.width_px && v < camera_.height_px;
  }

  bool is_link(int u, int v) const {
    return robot_.link_id(u, v) != kNoLink && robot_.link_id(u, v) != kEnvironmentLink;
  }

  PixelFate fate_alone(int u, int v) const {
    if (std::isnan(sensor_(u, v))) return PixelFate::no_reading;
    if (robot_.link_id(u, v) != kNoLink && belongs(u, v, robot_.depth_m(u, v)))
      return is_link(u, v) ? PixelFate::robot : PixelFate::environment;
    if (is_padding(u, v)) return PixelFate::padding;
    if (is_dilation(u, v)) return PixelFate::dilation;
    return is_mixed(u, v, 1, 0) || is_mixed(u, v, 0, 1) ? PixelFate::edge : PixelFate::obstacle;
  }

  bool belongs(int u, int v, float z) const { return sensor_(u, v) >= least_m(z); }

  float least_m(float z) const {
    const auto a = static_cast<float>(settings_.tolerance_m);
    const auto b = static_cast<float>(settings_.tolerance_per_m);
    const auto c = static_cast<float>(settings_.tolerance_per_m2);
    return z - (a + (b * z + c * z * z));
  }

  /// What the robot's outline of this depth takes beside it.
  bool belongs_beside(int u, int v, float z) const {
    const float most_m = z + static_cast<float>(settings_.padding_depth_m);
    return belongs(u, v, z) && (sensor_(u, v) <= most_m || !is_on_surface(u, v));
  }

  bool is_on_surface(int u, int v) const {
    const float z = sensor_(u, v);
    const float jump = 0.03F * std::max(1.0F, z * z);
    int joined = 0;
    for (int dv = -1; dv <= 1; ++dv) {
      for (int du = -1; du <= 1; ++du) {
        const bool is_neighbour = (du != 0 || dv != 0) && is_inside(u + du, v + dv);
        joined += is_neighbour && std::abs(sensor_(u + du, v + dv) - z) <= jump;
      }
    }
    return joined >= 5;
  }

  bool is_outline(int u, int v) const {
    if (robot_.link_id(u, v) == kEnvironmentLink) return is_outline_of_environment(u, v);
    if (!is_link(u, v)) return false;
    const auto pixel_rad = static_cast<float>(1 / std::max(camera_.fx_px, camera_.fy_px));
    const auto ends_at = [&](int nu, int nv) {
      if (!is_inside(nu, nv)) return false;
      return !is_link(nu, nv) || robot_.depth_m(nu, nv) > robot_.depth_m(u, v) * (1 + pixel_rad);
    };
    return ends_at(u - 1, v) || ends_at(u + 1, v) || ends_at(u, v - 1) || ends_at(u, v + 1);
  }

  /// Where a reading on the environment, seen one pixel beside it, would be left over.
  bool is_outline_of_environment(int u, int v) const {
    const int neighbours[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    return std::any_of(std::begin(neighbours), std::end(neighbours), [&](const int* n) {
      if (!is_inside(u + n[0], v + n[1])) return false;
      if (robot_.link_id(u + n[0], v + n[1]) == kNoLink) return true;
      return robot_.depth_m(u, v) < least_m(robot_.depth_m(u + n[0], v + n[1]));
    });
  }

  /// Whole pixels to the side and along, by the ellipse's rows.
  static bool in_disc(int du, int dv, double radius_u_px, double radius_v_px) {
    if (std::abs(dv) > static_cast<int>(radius_v_px)) return false;
    const double share = dv / radius_v_px;
    const double half_px = radius_u_px * std::sqrt(std::max(0.0, 1 - share * share));
    return std::abs(du) <= static_cast<int>(half_px + 1e-9);
  }

  bool is_padding(int u, int v) const {
    return std::any_of(outline_.begin(), outline_.end(), [&](const Pixel& p) {
      return is_beside(u, v, p, settings_.padding_of(robot_.link_id(p.u, p.v)));
    });
  }

  /// Within radius_m of an outline pixel in the image, and of a depth that belongs to it.
  bool is_beside(int u, int v, Pixel outline, double radius_m) const {
    const double longest_px = std::max(camera_.width_px, camera_.height_px);
    const float z = robot_.depth_m(outline.u, outline.v);
    return radius_m > 0 && belongs_beside(u, v, z) &&
           in_disc(u - outline.u, v - outline.v, std::min(longest_px, radius_m * camera_.fx_px / z),
                   std::min(longest_px, radius_m * camera_.fy_px / z));
  }

  bool is_dilation(int u, int v) const {
    if (settings_.dilation_px == 0) return false;
    return std::any_of(outline_.begin(), outline_.end(), [&](const Pixel& p) {
      return belongs_beside(u, v, robot_.depth_m(p.u, p.v)) &&
             in_disc(u - p.u, v - p.v, settings_.dilation_px, settings_.dilation_px);
    });
  }

  bool is_mixed(int u, int v, int du, int dv) const {
    const auto jump_at_1m = static_cast<float>(settings_.edge_jump_m);
    if (jump_at_1m <= 0 || !is_inside(u - 2 * du, v - 2 * dv) || !is_inside(u + 2 * du, v + 2 * dv))
      return false;
    const float z = sensor_(u, v);
    const float before = sensor_(u - du, v - dv);
    const float after = sensor_(u + du, v + dv);
    const float jump = jump_at_1m * std::max(1.0F, z * z);
    const bool is_flat = std::abs(before - sensor_(u - 2 * du, v - 2 * dv)) <= jump &&
                         std::abs(after - sensor_(u + 2 * du, v + 2 * dv)) <= jump;
    return is_flat &&
           ((z - before > jump && after - z > jump) || (z - after > jump && before - z > jump));
  }

  bool is_near(int u, int v) const {
    return std::any_of(outline_.begin(), outline_.end(), [&](const Pixel& p) {
      return is_link(p.u, p.v) && is_beside(u, v, p, settings_.flying_patch_radius_m);
    });
  }

  void drop_flying_patches() {
    const Image<PixelFate> before = fate_;
    Image<std::uint8_t> walked(camera_.width_px, camera_.height_px, 0);
    const Image<std::uint8_t> reached = reached_from_robot(before);
    for_each([&](int u, int v) {
      if (before(u, v) != PixelFate::obstacle || walked(u, v) != 0) return;
      const std::vector<Pixel> piece = piece_at(u, v, before, walked);
      const bool stays = std::all_of(piece.begin(), piece.end(),
                                     [&](const Pixel& p) { return is_near(p.u, p.v); });
      if (!stays || !hangs(piece, reached)) return;
      for (const Pixel& p : piece) fate_(p.u, p.v) = PixelFate::flying_patch;
    });
  }

  bool is_joined(int u, int v, int du, int dv) const {
    if (!is_inside(u + du, v + dv)) return false;
    const float a = sensor_(u, v);
    const float b = sensor_(u + du, v + dv);
    const float jump = static_cast<float>(settings_.flying_patch_jump_m);
    return std::abs(a - b) <= jump * std::max(1.0F, std::min(a * a, b * b));
  }

  /// The robot's own readings, and what they lead to within padding and dilation: flooded until
  /// nothing changes.
  Image<std::uint8_t> reached_from_robot(const Image<PixelFate>& fate) const {
    Image<std::uint8_t> reached(camera_.width_px, camera_.height_px, 0);
    const auto a = static_cast<float>(settings_.tolerance_m);
    const auto b = static_cast<float>(settings_.tolerance_per_m);
    const auto c = static_cast<float>(settings_.tolerance_per_m2);
    for_each([&](int u, int v) {
      const float z = robot_.depth_m(u, v);
      reached(u, v) =
          fate(u, v) == PixelFate::robot && sensor_(u, v) <= z + (a + (b * z + c * z * z));
    });
    bool changed = true;
    while (changed) {
      changed = false;
      for_each([&](int u, int v) {
        if (fate(u, v) != PixelFate::padding && fate(u, v) != PixelFate::dilation) return;
        if (reached(u, v) != 0 || !touches(u, v, reached)) return;
        reached(u, v) = 1;
        changed = true;
      });
    }
    return reached;
  }

  bool touches(int u, int v, const Image<std::uint8_t>& reached) const {
    for (int n = 0; n < 9; ++n) {
      const int du = n % 3 - 1;
      const int dv = n / 3 - 1;
      if (is_joined(u, v, du, dv) && reached(u + du, v + dv) != 0) return true;
    }
    return false;
  }

  bool hangs(const std::vector<Pixel>& piece, const Image<std::uint8_t>& reached) const {
    return std::any_of(piece.begin(), piece.end(),
                       [&](const Pixel& p) { return touches(p.u, p.v, reached); });
  }

  /// All that is joined by depth, wherever it goes.
  std::vector<Pixel> piece_at(int u, int v, const Image<PixelFate>& fate,
                              Image<std::uint8_t>& walked) const {
    std::vector<Pixel> piece{{u, v}};
    walked(u, v) = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Pixel p = piece[i];
      for (int n = 0; n < 9; ++n) {
        const Pixel q{p.u + n % 3 - 1, p.v + n / 3 - 1};
        if (!is_joined(p.u, p.v, n % 3 - 1, n / 3 - 1) || walked(q.u, q.v) != 0) continue;
        if (fate(q.u, q.v) != PixelFate::obstacle) continue;
        walked(q.u, q.v) = 1;
        piece.push_back(q);
      }
    }
    return piece;
  }

  const Camera& camera_;
  const DepthImage& sensor_;
  const RobotImage& robot_;
  const SelfFilterSettings& settings_;
  Image<PixelFate> fate_;
  std::vector<Pixel> outline_;
};

}  // namespace

ObstacleImage plain_self_filter(const Camera& camera, const DepthImage& sensor_depth_m,
                                const RobotImage& robot, const SelfFilterSettings& settings) {
  return PlainFilter(camera, sensor_depth_m, robot, settings).run();
}

}  // namespace berth
