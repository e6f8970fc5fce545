#include "berth/self_filter/surface_things.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace berth {
namespace {

constexpr double kThing_m2 = 3e-4;
constexpr float kEdgeStep_m = 0.03F;
constexpr float kBesideEdge_m = 0.02F;
/// A camera that reads surfaces to this tolerance draws depth edges where they are.
constexpr float kSharp_m = 0.015F;
constexpr float kBesideSharpEdge_m = 0.005F;
constexpr float kBeforeEdge_m = 0.01F;

/// The reading itself stands off by this share of the tolerance, as the median around it by all.
constexpr float kReadingShare = 0.8F;

float growth(float z_m) {
  return std::max(static_cast<float>(kLeastSurfaceGrowth), 0.65F + 0.35F * z_m * z_m);
}

PixelRect square_around(Pixel p, int reach_px, int width, int height) {
  return clip({p.u - reach_px, p.v - reach_px, p.u + reach_px + 1, p.v + reach_px + 1}, width,
              height);
}

/// The deviations of an image's readings from the model, sorted into bins.
class Deviations {
 public:
  void add(double deviation_m) {
    const double bin = std::floor((deviation_m + kMost_m) / kBin_m);
    ++bins_[static_cast<std::size_t>(std::clamp(bin, 0.0, double(kBins - 1)))];
    ++count_;
  }
  /// The SurfaceTolerance that they show.
  float tolerance_m() const {
    constexpr int kLeastPixels = 100;
    constexpr double kShare = 0.98;
    if (count_ < kLeastPixels) return static_cast<float>(kMostSurfaceTolerance_m);
    const double most_m = quantile_m(kShare), median_m = quantile_m(0.5);
    return static_cast<float>(std::clamp(std::max(most_m, most_m - 2 * median_m),
                                         kLeastSurfaceTolerance_m, kMostSurfaceTolerance_m));
  }

 private:
  /// What this share of them stays below, to a bin.
  double quantile_m(double share) const {
    int seen = 0;
    std::size_t bin = 0;
    while (bin + 1 < kBins && seen + bins_[bin] < share * count_) seen += bins_[bin++];
    return (static_cast<double>(bin) + 1) * kBin_m - kMost_m;
  }

  static constexpr double kMost_m = 0.05, kBin_m = 1e-4;
  static constexpr std::size_t kBins = 1000;
  std::array<int, kBins> bins_{};
  int count_ = 0;
};

/// Whether the model goes on all around, so that a calibration that is a little off shows the same
/// surface.
bool is_inside_surface(const RobotImage& robot, Pixel p, int reach_px, float reach_m) {
  const float z_m = robot.depth_m(p.u, p.v);
  for (int i = 0; i < 9; ++i) {
    const int u = p.u + (i % 3 - 1) * reach_px, v = p.v + (i / 3 - 1) * reach_px;
    if (u < 0 || v < 0 || u >= robot.depth_m.width() || v >= robot.depth_m.height()) return false;
    // False for NaN, too. Steeper surfaces are edges to a camera.
    if (!(std::abs(robot.depth_m(u, v) - z_m) <= 2 * reach_m)) return false;
  }
  return true;
}

class SurfaceThings {
 public:
  SurfaceThings(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                SurfaceThingsWorkspace& workspace, ObstacleImage& out)
      : camera_(camera),
        focal_px_(static_cast<float>(std::min(camera.fx_px, camera.fy_px))),
        per_column_(static_cast<float>(1 / camera.fx_px)),
        per_row_(static_cast<float>(1 / camera.fy_px)),
        sensor_depth_m_(sensor_depth_m),
        robot_(robot),
        workspace_(workspace),
        out_(out) {}

  void run() {
    find_candidates();
    for (const Pixel& p : workspace_.candidates) workspace_.state(p.u, p.v) = kStandsOff;
    for (const Pixel& p : workspace_.candidates) {
      if (workspace_.state(p.u, p.v) == kStandsOff) take_patch(p);
    }
    for (const Pixel& p : workspace_.candidates) workspace_.state(p.u, p.v) = kUnknown;
  }

 private:
  static constexpr int kPart_px = 16;
  enum State : std::uint8_t { kUnknown, kStandsOff, kTaken };

  float tolerance_at_1m_m(Pixel p) const {
    const SurfaceTolerance& t = out_.surface_tolerance;
    return robot_.link_id(p.u, p.v) == kEnvironmentLink ? t.environment_m : t.links_m;
  }

  void find_candidates() {
    workspace_.candidates.clear();
    const PixelRect rect = clip(robot_.extent, out_.fate.width(), out_.fate.height());
    const SurfaceTolerance& t = out_.surface_tolerance;
    const float corner =
        std::min({cosine(0, 0), cosine(camera_.width_px - 1, 0), cosine(0, camera_.height_px - 1),
                  cosine(camera_.width_px - 1, camera_.height_px - 1)});
    const float at_1m_m = kReadingShare * std::min(t.links_m, t.environment_m) * corner;
    for (int v = rect.v_begin; v < rect.v_end; ++v) {
      const float* const reading_m = sensor_depth_m_.row(v);
      const float* const model_m = robot_.depth_m.row(v);
      for (int begin = rect.u_begin; begin < rect.u_end; begin += kPart_px) {
        const int end = std::min(begin + kPart_px, rect.u_end);
        if (!any_nearer(reading_m, model_m, at_1m_m, begin, end)) continue;
        for (int u = begin; u < end; ++u) {
          const bool may = model_m[u] - reading_m[u] > at_1m_m * growth(reading_m[u]);
          if (may && stands_off({u, v})) workspace_.candidates.push_back({u, v});
        }
      }
    }
  }

  /// The compiler makes vectors of it; most parts of rows have none.
  static bool any_nearer(const float* reading_m, const float* model_m, float at_1m_m, int begin,
                         int end) {
    int any = 0;
    for (int u = begin; u < end; ++u) {
      any |= int(model_m[u] - reading_m[u] > at_1m_m * growth(reading_m[u]));
    }
    return any != 0;
  }

  /// Of the angle between a pixel's ray and the optical axis.
  float cosine(int u, int v) const {
    const float x = x_of(u), y = y_of(v);
    return 1 / std::sqrt(1 + x * x + y * y);
  }

  bool stands_off(Pixel p) const {
    const float model_m = robot_.depth_m(p.u, p.v), reading_m = sensor_depth_m_(p.u, p.v);
    const PixelFate fate = out_.fate(p.u, p.v);
    if (fate != PixelFate::robot && fate != PixelFate::environment) return false;
    const float at_1m_m = tolerance_at_1m_m(p);
    const float off_m = kReadingShare * at_1m_m * growth(reading_m);
    if (!(model_m - reading_m > off_m * cosine(p.u, p.v))) return false;
    const float z_m = median_m(p);
    const float t_m = at_1m_m * growth(z_m);
    return model_m - z_m > t_m * cosine(p.u, p.v) && !is_beside_edge(p, z_m) &&
           !is_near_model(p, z_m, t_m);
  }

  /// Of the readings in 3 x 3 pixels.
  float median_m(Pixel p) const {
    std::array<float, 9> readings_m{};
    std::size_t count = 0;
    const PixelRect square = square_around(p, 1, out_.fate.width(), out_.fate.height());
    for (int v = square.v_begin; v < square.v_end; ++v) {
      for (int u = square.u_begin; u < square.u_end; ++u) {
        const float z_m = sensor_depth_m_(u, v);
        if (!std::isnan(z_m)) readings_m[count++] = z_m;
      }
    }
    const auto middle = readings_m.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(readings_m.begin(), middle,
                     readings_m.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
  }

  bool is_beside_edge(Pixel p, float z_m) const {
    const float edge_m = std::min(robot_.depth_m(p.u, p.v) - kEdgeStep_m, z_m + kBeforeEdge_m);
    const float beside_m = tolerance_at_1m_m(p) > kSharp_m ? kBesideEdge_m : kBesideSharpEdge_m;
    const int reach_px = std::max(1, static_cast<int>(std::lround(beside_m * focal_px_ / z_m)));
    return any_model(p, reach_px, std::max(1, reach_px / 4),
                     [&](int, int, float model_m) { return model_m < edge_m; });
  }

  bool is_near_model(Pixel p, float z_m, float t_m) const {
    const int reach_px = static_cast<int>(t_m * focal_px_ / z_m) + 1;
    const float x_m = x_of(p.u) * z_m, y_m = y_of(p.v) * z_m;
    return any_model(p, reach_px, std::max(1, reach_px / 6), [&](int u, int v, float model_m) {
      const float dx_m = x_of(u) * model_m - x_m, dy_m = y_of(v) * model_m - y_m;
      const float dz_m = model_m - z_m;
      return dx_m * dx_m + dy_m * dy_m + dz_m * dz_m < t_m * t_m;
    });
  }

  float x_of(int u) const { return static_cast<float>(u - camera_.cx_px) * per_column_; }
  float y_of(int v) const { return static_cast<float>(v - camera_.cy_px) * per_row_; }

  /// Whether it holds for one of the model's pixels around p, each step_px-th in both directions
  /// from p on; from p outwards.
  template <class Holds>
  bool any_model(Pixel p, int reach_px, int step_px, const Holds& holds) const {
    const auto in_row = [&](int v) {
      if (v < 0 || v >= robot_.depth_m.height()) return false;
      const int first = p.u - std::min(p.u, reach_px) / step_px * step_px;
      const int last = std::min(robot_.depth_m.width() - 1, p.u + reach_px);
      const float* const model_m = robot_.depth_m.row(v);
      for (int u = first; u <= last; u += step_px) {
        if (holds(u, v, model_m[u])) return true;
      }
      return false;
    };
    if (in_row(p.v)) return true;
    for (int aside = step_px; aside <= reach_px; aside += step_px) {
      if (in_row(p.v - aside) || in_row(p.v + aside)) return true;
    }
    return false;
  }

  void take_patch(Pixel start) {
    std::vector<Pixel>& patch = workspace_.patch;
    patch.assign(1, start);
    workspace_.state(start.u, start.v) = kTaken;
    double area_m2 = 0;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      const Pixel p = patch[i];
      const double z_m = sensor_depth_m_(p.u, p.v);
      area_m2 += z_m * z_m / (camera_.fx_px * camera_.fy_px);
      const PixelRect square = square_around(p, 1, out_.fate.width(), out_.fate.height());
      for (int v = square.v_begin; v < square.v_end; ++v) {
        for (int u = square.u_begin; u < square.u_end; ++u) {
          if (workspace_.state(u, v) != kStandsOff) continue;
          workspace_.state(u, v) = kTaken;
          patch.push_back({u, v});
        }
      }
    }
    if (area_m2 < kThing_m2) return;
    for (const Pixel& p : patch) keep(p);
  }

  void keep(Pixel p) {
    PixelFate& fate = out_.fate(p.u, p.v);
    --out_.count[static_cast<std::size_t>(fate)];
    ++out_.count[static_cast<std::size_t>(PixelFate::obstacle)];
    fate = PixelFate::obstacle;
    out_.depth_m(p.u, p.v) = sensor_depth_m_(p.u, p.v);
    workspace_.things.push_back(p);
  }

  const Camera& camera_;
  float focal_px_;
  float per_column_, per_row_;
  DepthView sensor_depth_m_;
  const RobotImage& robot_;
  SurfaceThingsWorkspace& workspace_;
  ObstacleImage& out_;
};

}  // namespace

SurfaceTolerance measured_surface_tolerance(const Camera& camera, DepthView sensor_depth_m,
                                            const RobotImage& robot) {
  constexpr int kStep_px = 3;
  constexpr double kInside_m = 0.015, kFarthest_m = 0.05;
  const double focal_px = std::min(camera.fx_px, camera.fy_px);
  Deviations links, environment;
  const PixelRect rect = clip(robot.extent, camera.width_px, camera.height_px);
  // The same pixels, however tight the extent is.
  const auto first = [](int begin) { return (begin + kStep_px - 1) / kStep_px * kStep_px; };
  for (int v = first(rect.v_begin); v < rect.v_end; v += kStep_px) {
    for (int u = first(rect.u_begin); u < rect.u_end; u += kStep_px) {
      const float model_m = robot.depth_m(u, v);
      const double off_m = sensor_depth_m(u, v) - model_m;
      const double grown = surface_growth(model_m);
      // A farther reading is another thing, and no error.
      if (!(std::abs(off_m) <= kFarthest_m * grown)) continue;
      const int reach_px = static_cast<int>(kInside_m * focal_px / model_m) + 1;
      if (!is_inside_surface(robot, {u, v}, reach_px, kInside_m)) continue;
      (robot.link_id(u, v) == kEnvironmentLink ? environment : links).add(off_m / grown);
    }
  }
  return {links.tolerance_m(), environment.tolerance_m()};
}

void find_surface_things(const Camera& camera, DepthView sensor_depth_m, const RobotImage& robot,
                         const SelfFilterSettings& settings, SurfaceThingsWorkspace& workspace,
                         ObstacleImage& out) {
  workspace.things.clear();
  out.surface_tolerance = {};
  if (settings.surface_tolerance_m == 0.0) return;
  if (const auto given_m = settings.surface_tolerance_m) {
    out.surface_tolerance.links_m = out.surface_tolerance.environment_m =
        static_cast<float>(*given_m);
  } else {
    out.surface_tolerance = measured_surface_tolerance(camera, sensor_depth_m, robot);
  }
  if (workspace.state.width() != camera.width_px || workspace.state.height() != camera.height_px) {
    workspace.state.resize(camera.width_px, camera.height_px, 0);
  }
  SurfaceThings(camera, sensor_depth_m, robot, workspace, out).run();
}

}  // namespace berth
