#include "sim/structured_light.hpp"

#include <algorithm>
#include <cmath>

#include "sim/sensor_model.hpp"

namespace berth::sim {
namespace {

constexpr float kBaseline_m = 0.075f;
// Disparity steps are 1/8 px of a 580 px focal length: one step is z^2 / 350 m deep.
constexpr float kStepsTimesMetres = 350.0f;
constexpr float kNoise_m_at_1m = 0.0015f;
constexpr float kNear_m = 0.5f, kFar_m = 5.0f;
constexpr float kWander_px = 0.6f;
constexpr float kMixedShare = 0.06f, kOutlineShare = 0.75f;
constexpr float kFlatCosine = 0.20f;
constexpr int kSpots = 25, kSpotRadius_px = 3;

float uniform(Random& random) { return static_cast<float>(random(0, 1)); }

// Gaussian noise of deviation 1, alike among neighbours as the sensor's matching windows make it.
Image<float> smooth_noise(int width, int height, Random& random) {
  constexpr int kSide = 3;
  Image<float> white(width + kSide - 1, height + kSide - 1);
  for (float& w : white.pixels()) w = static_cast<float>(random.gaussian());
  Image<float> smooth(width, height, 0);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u)
      for (int k = 0; k < kSide * kSide; ++k)
        smooth(u, v) += white(u + k % kSide, v + k / kSide) / kSide;
  return smooth;
}

// What the sensor's pixels look at.
struct Looked {
  DepthImage depth_m;
  Image<float> cosine;
};

// Outlines wander, because matching windows straddle them; smooth surfaces stay where they are.
Looked wander(const CleanView& view, Random& random) {
  const int width = view.hit.width(), height = view.hit.height();
  const Image<float> du = smooth_noise(width, height, random);
  const Image<float> dv = smooth_noise(width, height, random);
  Looked at{DepthImage(width, height, kNoDepth), Image<float>(width, height, 0)};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      int x = std::clamp(u + static_cast<int>(std::lround(kWander_px * du(u, v))), 0, width - 1);
      int y = std::clamp(v + static_cast<int>(std::lround(kWander_px * dv(u, v))), 0, height - 1);
      const float here_m = view.hit(u, v).depth_m, there_m = view.hit(x, y).depth_m;
      if (std::abs(there_m - here_m) < kEdgeRatio * here_m) x = u, y = v;
      if (!view.lit(x, y)) continue;
      at.depth_m(u, v) = view.hit(x, y).depth_m;
      at.cosine(u, v) = view.hit(x, y).cosine;
    }
  }
  return at;
}

// The far side of an edge mostly has no reading, and now and then one between the two surfaces.
void spoil_edges(DepthImage& depth_m, Random& random) {
  const DepthImage before = depth_m;
  at_far_sides(before, [&](int u, int v, float near) {
    const float luck = uniform(random), share = uniform(random);
    if (luck < kMixedShare)
      depth_m(u, v) = near + share * (before(u, v) - near);
    else if (luck < kMixedShare + kOutlineShare)
      depth_m(u, v) = kNoDepth;
  });
}

void add_spots(DepthImage& depth_m, Random& random) {
  for (int spot = 0; spot < kSpots; ++spot) {
    const int u0 = static_cast<int>(uniform(random) * static_cast<float>(depth_m.width()));
    const int v0 = static_cast<int>(uniform(random) * static_cast<float>(depth_m.height()));
    const float radius = kSpotRadius_px * uniform(random);
    for (int v = std::max(v0 - kSpotRadius_px, 0);
         v < std::min(v0 + kSpotRadius_px, depth_m.height()); ++v)
      for (int u = std::max(u0 - kSpotRadius_px, 0);
           u < std::min(u0 + kSpotRadius_px, depth_m.width()); ++u)
        if (std::hypot(u - u0, v - v0) < radius) depth_m(u, v) = kNoDepth;
  }
}

// The disparity in whole steps, back in mm.
std::uint16_t measure_mm(float depth_m, float noise) {
  constexpr float kNoise_steps = kNoise_m_at_1m * kStepsTimesMetres;
  const float steps = std::round(kStepsTimesMetres / depth_m + kNoise_steps * noise);
  const float measured_m = kStepsTimesMetres / steps;
  if (!(measured_m >= kNear_m && measured_m <= kFar_m)) return 0;
  return static_cast<std::uint16_t>(std::lround(1000 * measured_m));
}

}  // namespace

CleanView look(const RayCaster& scene) {
  const Camera& camera = scene.camera();
  CleanView view{scene.cast(), Image<std::uint8_t>(camera.width_px, camera.height_px, 0)};
  const Eigen::Vector3f projector_C_m(kBaseline_m, 0, 0);
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const SurfaceHit& hit = view.hit(u, v);
      if (hit.mesh == kNoMesh) continue;
      const Eigen::Vector3f point_C_m =
          hit.depth_m * Eigen::Vector3f(static_cast<float>((u - camera.cx_px) / camera.fx_px),
                                        static_cast<float>((v - camera.cy_px) / camera.fy_px), 1);
      view.lit(u, v) = !scene.is_blocked(point_C_m, projector_C_m);
    }
  }
  return view;
}

Image<std::uint16_t> sense(const CleanView& view, Random& random) {
  auto [depth_m, cosine] = wander(view, random);
  spoil_edges(depth_m, random);
  add_spots(depth_m, random);
  const Image<float> noise = smooth_noise(depth_m.width(), depth_m.height(), random);
  Image<std::uint16_t> measured_mm(depth_m.width(), depth_m.height(), 0);
  for (int v = 0; v < depth_m.height(); ++v)
    for (int u = 0; u < depth_m.width(); ++u) {
      const bool lost = std::isnan(depth_m(u, v)) || cosine(u, v) < kFlatCosine * uniform(random);
      if (!lost) measured_mm(u, v) = measure_mm(depth_m(u, v), noise(u, v));
    }
  return measured_mm;
}

}  // namespace berth::sim
