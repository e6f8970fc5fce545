#pragma once

#include <cstdint>
#include <list>
#include <utility>

#include "berth/render/robot_renderer.hpp"
#include "lab/trust/condition.hpp"
#include "sim/drawn_scene.hpp"

namespace berth::lab {

/// One drawn scene as a bad sensor and a bad calibration show it. Each image is made once.
class SceneImages {
 public:
  /// All are kept, none is copied.
  SceneImages(const RobotModel& model, const std::shared_ptr<const LinkMeshes>& meshes,
              const sim::DrawnScene& scene, std::uint32_t seed)
      : model_(model), meshes_(meshes), scene_(scene), seed_(seed) {}

  /// The sensor's image.
  const DepthImage& sensed(const sim::SensorErrors& errors);
  /// The robot where berth believes that it is.
  const RobotImage& believed(const PoseErrors& errors);
  /// The camera where berth believes that it is.
  Pose believed_X_BC(const PoseErrors& errors) const;

 private:
  DepthImage sense(const sim::SensorErrors& errors) const;
  RobotImage render(const PoseErrors& errors) const;

  const RobotModel& model_;
  const std::shared_ptr<const LinkMeshes>& meshes_;
  const sim::DrawnScene& scene_;
  const std::uint32_t seed_;
  std::list<std::pair<sim::SensorErrors, DepthImage>> sensed_;
  std::list<std::pair<PoseErrors, RobotImage>> believed_;
};

}  // namespace berth::lab
