#include "apps/view/part_pictures.hpp"

#include <algorithm>
#include <optional>

#include "apps/berth/attached_picture.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth::app {
namespace {

/// The frame of this camera in which the part has the most pixels; none where it sees nothing of
/// it.
std::optional<std::size_t> clearest_frame(CalibratedRobot& robot, LinkId part_id) {
  std::optional<std::size_t> clearest;
  std::ptrdiff_t most = 0;
  for (std::size_t k = 0; k < robot.source().frames.size(); ++k) {
    const RobotImage* image = robot.draw(k, CalibrationSide::after);
    if (!image) continue;
    const std::ptrdiff_t pixels = std::ranges::count(image->link_id.pixels(), part_id);
    if (pixels <= most) continue;
    most = pixels;
    clearest = k;
  }
  return clearest;
}

}  // namespace

std::vector<PartPicture> part_pictures(const CalibrationData& calibration_data,
                                       const CalibrationResult& found, const AttachedPart& part) {
  const CarryingRobotData carrying(calibration_data, {{part}, ""}, CarriedParts::all);
  const auto bare_links = static_cast<LinkId>(calibration_data.model->link_count());
  std::vector<PartPicture> pictures;
  for (std::size_t camera = 0; camera < found.cameras.size(); ++camera) {
    CalibratedRobot robot(carrying.calibration_data(), found, camera);
    const auto k = clearest_frame(robot, static_cast<LinkId>(bare_links + 1));
    if (!k) continue;
    const CalibrationFrame& frame = robot.source().frames[*k];
    const RobotImage* image = robot.draw(*k, CalibrationSide::after);
    pictures.push_back(
        {robot.source().name, frame.number,
         attached_picture_png({frame.depth_m, depth_tone(frame.depth_m), image, bare_links})});
  }
  return pictures;
}

}  // namespace berth::app
