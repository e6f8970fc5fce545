// A way to find the distances of the whole robot to what several cameras left.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lab/bench/whole_robot_scene.hpp"

namespace berth::lab {

/// A method has a file of its own, cameras_<name>.cpp.
class CamerasPeer {
 public:
  CamerasPeer() = default;
  virtual ~CamerasPeer() = default;
  CamerasPeer(const CamerasPeer&) = delete;
  CamerasPeer& operator=(const CamerasPeer&) = delete;

  virtual std::string name() const = 0;
  /// What its answer lacks beside the two distances of `mesh`.
  virtual std::string lacks() const = 0;
  /// What has to be made anew for each set of frames; timed.
  virtual void build(const WholeRobotScene& scene) = 0;
  /// All links; timed. `scene` is the one of the last build(). [i] is the link with the id i + 1;
  /// nothing where no obstacle lies within range_m.
  virtual std::vector<std::optional<double>> ask(const WholeRobotScene& scene, double range_m) = 0;
};

/// A KD-tree over the readings, asked for points of the links' surfaces at most 5 mm apart.
std::unique_ptr<CamerasPeer> make_cameras_nanoflann(const RobotModel& model);
/// FCL's distance between the links' meshes and an octree that the readings fill and their rays
/// clear, as in MoveIt.
std::unique_ptr<CamerasPeer> make_cameras_octomap(const RobotModel& model, double resolution_m);

}  // namespace berth::lab
