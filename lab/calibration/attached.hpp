// How well what a robot carries is found, in drawn cells.
#pragma once

#include <cstdint>

#include "berth/calibration/attached_parts.hpp"
#include "berth/robot/robot_model.hpp"
#include "sim/drawn_carried.hpp"
#include "sim/drawn_company.hpp"

namespace berth {
class LinkMeshes;
}

namespace berth::lab {

inline constexpr int kShown_px = 100;

/// One cell, and what was made of it.
struct AttachedTrial {
  int parts = 0;
  /// The number of poses in which some camera shows the thing on kShown_px pixels or more of every
  /// other one in both directions. Fewer than three of them prove nothing, however good the search
  /// is.
  int poses_shown = 0;
  /// Whether the thing's own link has a part.
  bool is_found = false;
  /// Of what was found on that link, the share that lies within 1 cm of the thing; and the other
  /// way round. NaN where nothing was found.
  double precision = 0;
  double recall = 0;
  /// Parts that are no thing that is carried: less than half of them lies within 1 cm of it.
  int false_parts = 0;
  /// Points of the room's surfaces that lie in a part at the pose of their image, and more than 2
  /// cm outside of the thing.
  int room_points = 0;
  double explained_share = 0;
  double time_s = 0;
};

/// With cameras that start 2 cm and 2 degrees off, and are calibrated first. Depends on its
/// arguments alone, but for the time.
AttachedTrial try_attached(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                           sim::DrawnKind kind, int poses, int cameras, std::uint32_t seed);

/// The finding on a robot that carries nothing, with company in its images. The cameras are off
/// by half a centimetre and half a hundredth of a radian. Depends on its arguments alone.
AttachedParts try_company(const RobotModel& model, std::shared_ptr<const LinkMeshes> meshes,
                          sim::DrawnCompany company, int poses, int cameras, std::uint32_t seed);

}  // namespace berth::lab
