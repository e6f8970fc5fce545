#include "berth/pipeline/robot_drawing.hpp"

namespace berth {

void RobotDrawing::draw(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  const bool stands_still = still_.stand_at(pose, X_BC);
  if (stands_still && has_rendered_) {
    image = rendered_;
    return;
  }
  renderer_.render(pose, X_BC, image);
  still_.drawn_at(pose, X_BC);
  has_rendered_ = stands_still;
  if (stands_still) rendered_ = image;
}

}  // namespace berth
