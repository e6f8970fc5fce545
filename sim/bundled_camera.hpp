// The cameras around the scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "sim/shapes.hpp"

namespace berth::sim {

/// Of a camera's optical frame C in the table's frame T; rounded as the file's text is.
struct BundledPlace {
  Eigen::Vector3d xyz_T_m;
  Eigen::Quaterniond rotation_TC;
  Pose X_TC() const;
};

struct BundledCamera {
  std::string name;
  Camera camera;
  BundledPlace place;
  std::vector<double> stamps_s;  ///< of its exposures
  std::uint32_t seed;            ///< of its sensor's noise
  std::string info_file;
  std::string depth_folder;
};

/// The first is the one of one_camera.yaml and truth.csv. They are not in step: no two expose at
/// the same time, and none does at a row of the joints.
std::vector<BundledCamera> bundled_cameras();

}  // namespace berth::sim
