// A way to say where a robot is free: berth's own, or what a planner could take instead.
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "berth/types/verdict.hpp"
#include "lab/planning/configuration_room.hpp"

namespace berth::lab {

/// A method has a file of its own, peer_<name>.cpp.
class PlanningPeer {
 public:
  PlanningPeer() = default;
  virtual ~PlanningPeer() = default;
  PlanningPeer(const PlanningPeer&) = delete;
  PlanningPeer& operator=(const PlanningPeer&) = delete;

  virtual std::string name() const = 0;
  /// What has to be made anew for each set of frames; timed. Nobody asks about places outside of
  /// the box.
  virtual void build(const FrameList& frames, const Eigen::AlignedBox3d& box_B_m) = 0;
  /// Of the moved links at each configuration, which come one after another; timed.
  virtual void ask(std::span<const double> positions, double margin_m,
                   std::span<Verdict> verdicts) = 0;
};

/// A KD-tree over the readings (nanoflann), asked for the balls of ConfigurationCheck: as VAMP asks
/// a CAPT.
std::unique_ptr<PlanningPeer> make_points_peer(const RobotModel& model);
/// FCL's distance between the links' meshes and an octree that readings fill and rays clear, as in
/// MoveIt. What no ray went through is free, as there, or occupied.
std::unique_ptr<PlanningPeer> make_octomap_peer(const RobotModel& model, double resolution_m,
                                                bool is_unknown_occupied);

/// Calls take(p_B_m) for the centre of each pixel that has a depth, in the robot's root frame.
template <class Take>
void for_each_point(const Frame& frame, const DepthImage& depth_m, Take take) {
  const Camera& camera = frame.mounted->camera();
  for (int v = 0; v < camera.height_px; ++v) {
    for (int u = 0; u < camera.width_px; ++u) {
      const double z_m = depth_m(u, v);
      if (std::isnan(z_m)) continue;
      take(frame.X_BC * Eigen::Vector3d((u - camera.cx_px) / camera.fx_px * z_m,
                                        (v - camera.cy_px) / camera.fy_px * z_m, z_m));
    }
  }
}

}  // namespace berth::lab
