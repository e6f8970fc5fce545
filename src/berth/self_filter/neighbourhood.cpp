#include "berth/self_filter/neighbourhood.hpp"

namespace berth {

void Neighbourhood::begin(const Camera& camera, const RobotImage& robot,
                          const SelfFilterSettings& settings, const Outline& outline) {
  grown_.begin(camera, robot, settings, outline, PixelFate::flying_patch);
  outline_ = &outline;
  grid_ = tiles_of(camera);
  has_discs_ = false;
  is_found_.assign(grid_.count(), 0);
  near_.resize(grid_.count());
}

bool Neighbourhood::holds(Pixel p, DepthView sensor_depth_m, const Image<PixelFate>& fate) {
  if (!has_discs_) make_discs();
  const int column = p.u / kTileWidth_px;
  const int row = p.v / kTileHeight_px;
  const std::size_t tile = grid_.index(column, row);
  if (is_found_[tile] == 0) {
    near_[tile] = grown_.covered(column, row, sensor_depth_m, fate);
    is_found_[tile] = 1;
  }
  return (near_[tile][p.v % kTileHeight_px] >> (p.u % kTileWidth_px) & 1) != 0;
}

void Neighbourhood::make_discs() {
  for (int row = outline_->tiles().v_begin; row < outline_->tiles().v_end; ++row)
    grown_.make_discs(row);
  grown_.end_discs();
  has_discs_ = true;
}

}  // namespace berth
