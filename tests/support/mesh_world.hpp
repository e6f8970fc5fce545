// A robot of loose links among obstacles, and what several cameras see of both.
#pragma once

#include <cstdint>
#include <vector>

#include "berth/distance/mesh_distances.hpp"
#include "sim/random.hpp"

namespace berth::testing {

struct MeshWorldSettings {
  int views = 2;
  int width_px = 32;
  int height_px = 24;
  int links = 3;
  int obstacles = 4;
  /// Pixels that lose their reading.
  double dropout = 0.01;
  /// Whether environment, flying patches and holes are among what hides.
  bool hides_otherwise = true;
  SpaceSettings space = {};
};

/// One camera's part.
struct MeshWorldView {
  Camera camera;
  Pose X_BC = Pose::Identity();
  DepthImage sensor_depth_m;
  ObstacleImage obstacles;
  DepthImage environment_front_m;
  DepthImage environment_back_m;

  EnvironmentSurfaces environment() const { return {environment_front_m, environment_back_m}; }
  double age_s = 0;
};

struct MeshWorld {
  RobotModel model;
  RobotPose pose;
  SpaceSettings settings;
  std::vector<MeshWorldView> views;
};

/// Depends on its arguments alone. Some pixels have each of the fates that a reading can have.
MeshWorld draw_mesh_world(const MeshWorldSettings& settings, std::uint32_t seed);

/// A world made ready to ask; holds what a UnknownSpace points at.
class PreparedWorld {
 public:
  explicit PreparedWorld(const MeshWorld& world);
  const MeshWorld& world() const { return world_; }
  const RobotPatches& patches() const { return *patches_; }
  const UnknownSpace& space() const { return space_; }
  std::vector<WholeLinkDistance> ask(const MeshRequest& request) const;

 private:
  const MeshWorld& world_;
  std::shared_ptr<const RobotPatches> patches_;
  std::vector<CameraSpace> spaces_;
  UnknownSpace space_;
};

}  // namespace berth::testing
