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
    is_thing_ = Image<std::uint8_t>(camera_.width_px, camera_.height_px, 0);
    if (settings_.surface_tolerance_m != 0.0) find_surface_things();
    if (settings_.flying_patch_radius_m > 0) judge_flying_patches();
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
    return PixelFate::obstacle;
  }

  bool belongs(int u, int v, float z) const { return sensor_(u, v) >= least_m(z); }

  float least_m(float z) const {
    const auto a = static_cast<float>(settings_.tolerance_m);
    const auto c = static_cast<float>(settings_.tolerance_per_m2);
    return z - (a + c * z * z);
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

  bool is_near(int u, int v) const {
    return std::any_of(outline_.begin(), outline_.end(), [&](const Pixel& p) {
      return is_link(p.u, p.v) && is_beside(u, v, p, settings_.flying_patch_radius_m);
    });
  }

  static double growth(double z) { return std::max(0.8, 0.65 + 0.35 * z * z); }

  /// 98 of 100 readings of a surface stay below it on either side of their median, to 0.1 mm.
  double measured_tolerance_m(bool of_environment) const {
    std::vector<int> tenths_mm;
    for (int v = 0; v < camera_.height_px; v += 3) {
      for (int u = 0; u < camera_.width_px; u += 3) {
        const float z = robot_.depth_m(u, v);
        if (std::isnan(z) || (robot_.link_id(u, v) == kEnvironmentLink) != of_environment) continue;
        const double off = sensor_(u, v) - z;
        if (!(std::abs(off) <= 0.05 * growth(z)) || !goes_on(u, v, z)) continue;
        const double bin = std::floor((off / growth(z) + 0.05) / 1e-4);
        tenths_mm.push_back(static_cast<int>(std::min(bin, 999.0)) + 1 - 500);
      }
    }
    if (tenths_mm.size() < 100) return 0.025;
    std::sort(tenths_mm.begin(), tenths_mm.end());
    const auto below = [&](double share) {
      const auto wanted = static_cast<std::size_t>(std::ceil(share * tenths_mm.size()));
      return 1e-4 * tenths_mm[wanted - 1];
    };
    const double most = below(0.98), median = below(0.5);
    return std::clamp(median < 0 ? most - 2 * median : most, 0.010, 0.025);
  }

  bool goes_on(int u, int v, float z) const {
    const int reach = static_cast<int>(0.015 * focal_px() / z) + 1;
    for (const int dv : {-reach, 0, reach}) {
      for (const int du : {-reach, 0, reach}) {
        if (!is_inside(u + du, v + dv)) return false;
        if (!(std::abs(robot_.depth_m(u + du, v + dv) - z) <= 0.03F)) return false;
      }
    }
    return true;
  }

  double focal_px() const { return std::min(camera_.fx_px, camera_.fy_px); }

  Eigen::Vector3f point(int u, int v, float z) const {
    return {static_cast<float>((u - camera_.cx_px) / camera_.fx_px) * z,
            static_cast<float>((v - camera_.cy_px) / camera_.fy_px) * z, z};
  }

  void find_surface_things() {
    const double of_links = settings_.surface_tolerance_m.value_or(measured_tolerance_m(false));
    const double of_environment =
        settings_.surface_tolerance_m.value_or(measured_tolerance_m(true));
    Image<std::uint8_t> open(camera_.width_px, camera_.height_px, 0);
    for_each([&](int u, int v) {
      const bool is_link_pixel = fate_(u, v) == PixelFate::robot;
      if (!is_link_pixel && fate_(u, v) != PixelFate::environment) return;
      open(u, v) = stands_off(u, v, static_cast<float>(is_link_pixel ? of_links : of_environment));
    });
    for_each([&](int u, int v) {
      if (open(u, v) == 0) return;
      const std::vector<Pixel> patch = patch_at(u, v, open);
      if (area_m2(patch) < 3e-4) return;
      for (const Pixel& p : patch) {
        fate_(p.u, p.v) = PixelFate::obstacle;
        is_thing_(p.u, p.v) = 1;
      }
    });
  }

  bool stands_off(int u, int v, float tolerance_1m) const {
    const float length = point(u, v, 1).norm();
    const auto own_t = 0.8F * tolerance_1m * static_cast<float>(growth(sensor_(u, v)));
    if (!((robot_.depth_m(u, v) - sensor_(u, v)) * length > own_t)) return false;
    const float z = median(u, v);
    const auto t = tolerance_1m * static_cast<float>(growth(z));
    const auto reach = static_cast<int>(t * static_cast<float>(focal_px()) / z) + 1;
    bool is_near = false;
    around(u, v, reach, std::max(1, reach / 6), [&](int i, int j, float model) {
      is_near |= (point(i, j, model) - point(u, v, z)).squaredNorm() < t * t;
    });
    const float beside_m = tolerance_1m > 0.015F ? 0.02F : 0.005F;
    const int beside =
        std::max(1, static_cast<int>(std::lround(beside_m * static_cast<float>(focal_px()) / z)));
    const float edge = std::min(robot_.depth_m(u, v) - 0.03F, z + 0.01F);
    bool is_beside_edge = false;
    around(u, v, beside, std::max(1, beside / 4),
           [&](int, int, float model) { is_beside_edge |= model < edge; });
    // On its own ray the model is no nearer than along it.
    const float off = (robot_.depth_m(u, v) - z) * length;
    return off > t && !is_near && !is_beside_edge;
  }

  /// The model's pixels around one, each step-th.
  template <class Call>
  void around(int u, int v, int reach, int step, const Call& call) const {
    for (int dv = -(reach / step) * step; dv <= reach; dv += step) {
      for (int du = -(reach / step) * step; du <= reach; du += step) {
        if (is_inside(u + du, v + dv)) call(u + du, v + dv, robot_.depth_m(u + du, v + dv));
      }
    }
  }

  float median(int u, int v) const {
    std::vector<float> readings;
    for (int n = 0; n < 9; ++n) {
      const int i = u + n % 3 - 1, j = v + n / 3 - 1;
      if (is_inside(i, j) && !std::isnan(sensor_(i, j))) readings.push_back(sensor_(i, j));
    }
    std::sort(readings.begin(), readings.end());
    return readings[readings.size() / 2];
  }

  /// Side by side; takes them out of `open`.
  std::vector<Pixel> patch_at(int u, int v, Image<std::uint8_t>& open) const {
    std::vector<Pixel> patch{{u, v}};
    open(u, v) = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (int n = 0; n < 9; ++n) {
        const Pixel q{patch[i].u + n % 3 - 1, patch[i].v + n / 3 - 1};
        if (!is_inside(q.u, q.v) || open(q.u, q.v) == 0) continue;
        open(q.u, q.v) = 0;
        patch.push_back(q);
      }
    }
    return patch;
  }

  double area_m2(const std::vector<Pixel>& pixels) const {
    double sum = 0;
    for (const Pixel& p : pixels) {
      sum += sensor_(p.u, p.v) * double{sensor_(p.u, p.v)} / (camera_.fx_px * camera_.fy_px);
    }
    return sum;
  }

  void judge_flying_patches() {
    const Image<PixelFate> before = fate_;
    Image<std::uint8_t> walked(camera_.width_px, camera_.height_px, 0);
    const Image<std::uint8_t> reached = reached_from_robot(before);
    for_each([&](int u, int v) {
      if (before(u, v) != PixelFate::obstacle || walked(u, v) != 0) return;
      const std::vector<Pixel> piece = piece_at(u, v, before, walked);
      const bool stays = std::all_of(piece.begin(), piece.end(), [&](const Pixel& p) {
        return is_near(p.u, p.v) && is_thing_(p.u, p.v) == 0;
      });
      const bool is_crumb = area_m2(piece) < 1e-4;
      if (!stays || !hangs(piece, reached) || (!is_crumb && has_sharp_rim(piece, before))) return;
      for (const Pixel& p : piece) {
        fate_(p.u, p.v) = is_crumb ? PixelFate::speckle : PixelFate::flying_patch;
      }
    });
  }

  static bool shows_robot(PixelFate fate) {
    return fate == PixelFate::robot || fate == PixelFate::padding;
  }

  bool has_sharp_rim(const std::vector<Pixel>& piece, const Image<PixelFate>& fate) const {
    Image<std::uint8_t> of_piece(camera_.width_px, camera_.height_px, 0);
    for (const Pixel& p : piece) of_piece(p.u, p.v) = 1;
    int rim = 0, sharp = 0;
    for_each([&](int u, int v) {
      if (of_piece(u, v) != 0 || shows_robot(fate(u, v))) return;
      float nearest_m = HUGE_VALF;
      for (int n = 0; n < 9; ++n) {
        const int i = u + n % 3 - 1, j = v + n / 3 - 1;
        if (is_inside(i, j) && of_piece(i, j) != 0) nearest_m = std::min(nearest_m, sensor_(i, j));
      }
      if (nearest_m == HUGE_VALF) return;
      ++rim;
      sharp += is_sharp(u, v, nearest_m, of_piece, fate);
    });
    return sharp >= 10 && static_cast<float>(sharp) >= 0.25F * static_cast<float>(rim);
  }

  /// What follows the piece lies a step behind it.
  bool is_sharp(int u, int v, float piece_m, const Image<std::uint8_t>& of_piece,
                const Image<PixelFate>& fate) const {
    const float hole_px = std::max(1.5F, 0.004F * static_cast<float>(focal_px()) / piece_m);
    int nearest2 = static_cast<int>(hole_px * hole_px) + 1;
    float beyond_m = kNoDepth;
    around(u, v, static_cast<int>(hole_px), 1, [&](int i, int j, float) {
      const int off2 = (i - u) * (i - u) + (j - v) * (j - v);
      if (off2 > static_cast<int>(hole_px * hole_px) || off2 > nearest2) return;
      if (!(sensor_(i, j) > 0) || of_piece(i, j) != 0 || shows_robot(fate(i, j))) return;
      beyond_m = off2 == nearest2 ? std::min(beyond_m, sensor_(i, j)) : sensor_(i, j);
      nearest2 = off2;
    });
    return beyond_m > piece_m + 0.03F * std::max(1.0F, piece_m * piece_m);
  }

  bool is_joined(int u, int v, int du, int dv) const {
    if (!is_inside(u + du, v + dv)) return false;
    const float a = sensor_(u, v);
    const float b = sensor_(u + du, v + dv);
    return std::abs(a - b) <= 0.03F * std::max(1.0F, std::min(a * a, b * b));
  }

  /// The robot's own readings, and what they lead to within padding: flooded until
  /// nothing changes.
  Image<std::uint8_t> reached_from_robot(const Image<PixelFate>& fate) const {
    Image<std::uint8_t> reached(camera_.width_px, camera_.height_px, 0);
    const auto a = static_cast<float>(settings_.tolerance_m);
    const auto c = static_cast<float>(settings_.tolerance_per_m2);
    for_each([&](int u, int v) {
      const float z = robot_.depth_m(u, v);
      reached(u, v) = fate(u, v) == PixelFate::robot && sensor_(u, v) <= z + (a + c * z * z);
    });
    bool changed = true;
    while (changed) {
      changed = false;
      for_each([&](int u, int v) {
        if (fate(u, v) != PixelFate::padding) return;
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
  /// What stands off a surface.
  Image<std::uint8_t> is_thing_;
  std::vector<Pixel> outline_;
};

}  // namespace

ObstacleImage plain_self_filter(const Camera& camera, const DepthImage& sensor_depth_m,
                                const RobotImage& robot, const SelfFilterSettings& settings) {
  return PlainFilter(camera, sensor_depth_m, robot, settings).run();
}

}  // namespace berth
