#include "berth/pipeline/space_map.hpp"

#include "berth/pipeline/frame_set.hpp"

namespace berth {

SpaceMap::SpaceMap() : frames_(std::make_unique<FrameSet>()) {}
SpaceMap::~SpaceMap() = default;

const VoxelGrid& SpaceMap::update(const SpaceMapRequest& request, const TimeSettings& settings) {
  lay_voxels(request.box_B_m, request.edge_m, grid_);
  frames_->assign(request.frames.get(), settings, request.now_s, request.X_WB);
  find_voxels(frames_->space().views(), grid_);
  return grid_;
}

const std::vector<CameraState>& SpaceMap::cameras() const { return frames_->cameras(); }

std::optional<double> SpaceMap::newest_stamp_s() const {
  const Frame* newest = frames_->newest();
  return newest ? std::optional(newest->stamp_s) : std::nullopt;
}

}  // namespace berth
