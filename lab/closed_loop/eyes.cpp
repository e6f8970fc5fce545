#include "lab/closed_loop/eyes.hpp"

#include <cmath>
#include <limits>

#include "lab/closed_loop/encounter.hpp"

namespace berth::lab {
namespace {

/// A pixel of 10 beside a nearer surface mixes both, one of 100 has no reading.
constexpr double kMixed = 0.1, kDark = 0.01;
/// At 1 m; both grow with z^2.
constexpr float kStep_m = 0.0029F, kNoise_m = 0.0015F;
/// A neighbour that is nearer by this part is another surface.
constexpr float kEdgeRatio = 0.03F;

/// Quick, and good enough for noise (Marsaglia 2003).
class Noise {
 public:
  explicit Noise(std::uint32_t seed) : state_(2654435769U * (seed + 1)) {}
  std::uint32_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 17;
    return state_ ^= state_ << 5;
  }
  /// 0 to 1.
  float share() { return static_cast<float>(bits()) * 0x1p-32F; }
  /// Of deviation 1, at most 3.5: the sum of four bytes.
  float bell() {
    const std::uint32_t b = bits();
    const auto sum = (b & 255U) + (b >> 8 & 255U) + (b >> 16 & 255U) + (b >> 24);
    return (static_cast<float>(sum) - 510.0F) / 147.8F;
  }

 private:
  std::uint32_t state_;
};

/// What the sensor makes of the depth z, with the pixel's left and upper neighbours.
float reading_of(float z, float left, float up, Noise& noise) {
  const float near = std::fmin(left, up);
  if (near < (1 - kEdgeRatio) * z && noise.share() < kMixed) z = near + noise.share() * (z - near);
  if (noise.share() < kDark) return std::numeric_limits<float>::quiet_NaN();
  z = 1 / (kStep_m * std::nearbyint(1 / (kStep_m * z)));
  return z + kNoise_m * z * z * noise.bell();
}

DepthImage sensed(const DepthImage& ideal_m, std::uint32_t seed) {
  Noise noise(seed);
  DepthImage depth_m = ideal_m;
  for (int v = 1; v < ideal_m.height(); ++v) {
    for (int u = 1; u < ideal_m.width(); ++u) {
      depth_m(u, v) = reading_of(ideal_m(u, v), ideal_m(u - 1, v), ideal_m(u, v - 1), noise);
    }
  }
  return depth_m;
}

std::vector<std::size_t> links_with_mesh(const RobotModel& model) {
  std::vector<std::size_t> links;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    if (!model.links[i].mesh_L.empty()) links.push_back(i);
  }
  return links;
}

std::vector<TriangleMesh> all_meshes(const RobotModel& model) {
  std::vector<TriangleMesh> meshes;
  for (const std::size_t link : links_with_mesh(model)) meshes.push_back(model.links[link].mesh_L);
  for (TriangleMesh& part : person_parts()) meshes.push_back(std::move(part));
  return meshes;
}

}  // namespace

Eyes::Eyes(const RobotModel& model, std::uint32_t seed)
    : cameras_(cell_cameras()),
      links_(links_with_mesh(model)),
      caster_(all_meshes(model)),
      seed_(seed) {}

DepthImage Eyes::look(int camera, const RobotPose& pose, const std::vector<Pose>& X_BP) {
  std::vector<Pose> X_BM;
  for (const std::size_t link : links_) X_BM.push_back(pose.X_BL[link]);
  X_BM.insert(X_BM.end(), X_BP.begin(), X_BP.end());
  const CellCamera& eye = cameras_[camera];
  return sensed(caster_.cast(eye.camera, eye.X_BC, X_BM), ++seed_);
}

}  // namespace berth::lab
