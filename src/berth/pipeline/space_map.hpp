#pragma once

#include <memory>
#include <optional>

#include "berth/pipeline/request.hpp"
#include "berth/pipeline/timeliness.hpp"
#include "berth/space/voxel_grid.hpp"

namespace berth {

class FrameSet;

/// What planners ask: which parts of a box are occupied, free, hidden or unseen.
struct SpaceMapRequest {
  NewestFrames frames;
  /// As of a Request.
  std::optional<double> now_s = std::nullopt;
  std::optional<Pose> X_WB = std::nullopt;
  /// In the root link's frame.
  Eigen::AlignedBox3d box_B_m;
  double edge_m = 0.04;
};

/// The newest frames of one to eight cameras as voxels. The robot is not in them. One for each
/// thread; it may ask frames that a Query asks at the same time.
class SpaceMap {
 public:
  SpaceMap();
  ~SpaceMap();
  SpaceMap(const SpaceMap&) = delete;
  SpaceMap& operator=(const SpaceMap&) = delete;

  /// Valid until the next update. A frame that a Query would leave out is left out. Throws
  /// std::invalid_argument for a bad box or edge (lay_voxels).
  const VoxelGrid& update(const SpaceMapRequest& request, const TimeSettings& settings);

  /// How each camera of the last request stands.
  const std::vector<CameraState>& cameras() const;
  /// The newest exposure that it used; none where it used none.
  std::optional<double> newest_stamp_s() const;

 private:
  std::unique_ptr<FrameSet> frames_;
  VoxelGrid grid_;
};

}  // namespace berth
