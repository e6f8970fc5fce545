// Motion capture: the skeleton and the frames of a BVH file.
#pragma once

#include <Eigen/Geometry>

#include <filesystem>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"

namespace berth::sim {

struct BvhJoint {
  /// Empty for an end site, which has no turn of its own.
  std::string name;
  /// Its place in Bvh::joints, before this one; -1: the root.
  int parent = -1;
  /// In the parent's frame.
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
};

struct BvhFrame {
  Eigen::Vector3d root_m;
  /// Of each joint, against its parent.
  std::vector<Eigen::Quaterniond> turns;
};

/// As in the file, y up, but in metres.
struct Bvh {
  std::filesystem::path file;
  std::vector<BvhJoint> joints;
  double frame_s = 0;
  std::vector<BvhFrame> frames;

  /// From the first frame to the last one.
  double duration_s() const { return frame_s * static_cast<double>(frames.size() - 1); }
};

/// A BVH file does not tell its unit. It is the one of metres, centimetres, millimetres, inches and
/// CMU's 1/0.45 inch by which the skeleton at rest is 1.1 to 2.0 m high, up to the head's joint.
/// Position channels below the root, and files that are not BVH, are refused: throws
/// std::runtime_error with file, line, what is there and what was expected.
Bvh read_bvh(const std::filesystem::path& file);

/// X_WJ of each joint, W with z up. Between two frames turns are interpolated, so that no bone
/// changes its length; before the first frame and after the last one it stands still.
std::vector<Pose> joint_poses(const Bvh& bvh, double time_s);

}  // namespace berth::sim
