#include "apps/berth/calibration_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "apps/berth/calibration_picture.hpp"
#include "apps/berth/flying_pixels_at_robot.hpp"
#include "berth/files/file_bytes.hpp"
#include "berth/scene/calibrated_robot.hpp"

namespace berth::app {
namespace {

/// Around the robot, of the picture's longer side.
constexpr double kMargin = 0.08;
/// Where no robot is seen, and for thin ones.
constexpr int kLeastPart_px = 160;

/// One side of a frame, kept while both are drawn.
struct Side {
  RobotImage robot;
  DepthImage residual_m;
};

std::optional<Side> take(CalibratedRobot& calibrated, std::size_t frame, CalibrationSide side) {
  const RobotImage* robot = calibrated.draw(frame, side);
  if (!robot) return std::nullopt;
  return Side{*robot, calibrated.residual_m(frame, side, *robot)};
}

/// Around `seen`, in the image.
PixelRect with_margin(const PixelRect& seen, int width, int height) {
  if (seen.empty()) return {0, 0, width, height};
  const int longer = std::max(seen.u_end - seen.u_begin, seen.v_end - seen.v_begin);
  const int margin = static_cast<int>(kMargin * longer);
  const int more_u = std::max(margin, (kLeastPart_px - (seen.u_end - seen.u_begin)) / 2);
  const int more_v = std::max(margin, (kLeastPart_px - (seen.v_end - seen.v_begin)) / 2);
  return clip(
      {seen.u_begin - more_u, seen.v_begin - more_v, seen.u_end + more_u, seen.v_end + more_v},
      width, height);
}

class FrameWriter {
 public:
  FrameWriter(const std::filesystem::path& folder, std::size_t camera,
              const CalibratedRobot& calibrated)
      : folder_(folder), camera_(camera), calibrated_(calibrated) {}

  FramePictures write(std::size_t frame, const std::optional<Side>& before,
                      const std::optional<Side>& after) const {
    const CalibrationFrame& source = calibrated_.source().frames[frame];
    PixelRect seen;
    for (const auto* side : {&before, &after}) {
      if (*side) seen = united(seen, robot_rect((*side)->robot.link_id));
    }
    const PixelRect part = with_margin(seen, source.depth_m.width(), source.depth_m.height());
    return {source.number, write_side(frame, before, part, "before"),
            write_side(frame, after, part, "after")};
  }

 private:
  FramePicture write_side(std::size_t frame, const std::optional<Side>& side, const PixelRect& part,
                          const char* name) const {
    if (!side) return {};
    const CalibrationFrame& source = calibrated_.source().frames[frame];
    const Image<std::uint8_t> flying =
        flying_pixels_at_robot(calibrated_.source(), frame, side->robot);
    // By place, since a camera's name may hold what a file's may not.
    FramePicture picture{
        fmt::format("camera_{}_frame_{:06}_{}.png", camera_ + 1, source.number, name),
        std::accumulate(flying.pixels().begin(), flying.pixels().end(), 0)};
    write_file_bytes(folder_ / picture.file,
                     calibration_picture_png({source.depth_m, depth_tone(source.depth_m),
                                              &side->robot, side->residual_m, flying, part}));
    return picture;
  }

  const std::filesystem::path& folder_;
  std::size_t camera_;
  const CalibratedRobot& calibrated_;
};

}  // namespace

std::vector<std::size_t> frames_to_draw(const CalibrationCamera& camera,
                                        const CalibrationCoverage& coverage) {
  const std::size_t count = camera.frames.size();
  std::vector<std::size_t> chosen(std::min(count, kMostPictures));
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  if (count <= kMostPictures) return chosen;
  const auto worst = std::max_element(coverage.frames.begin(), coverage.frames.end(),
                                      [](const FrameCoverage& a, const FrameCoverage& b) {
                                        return a.median_residual_m < b.median_residual_m;
                                      });
  for (std::size_t i = 0; i < kMostPictures; ++i) chosen[i] = i * (count - 1) / (kMostPictures - 1);
  if (worst == coverage.frames.end()) return chosen;
  const auto at =
      std::find_if(camera.frames.begin(), camera.frames.end(),
                   [&](const CalibrationFrame& f) { return f.number == worst->number; });
  const auto index = static_cast<std::size_t>(at - camera.frames.begin());
  // In the place of the nearest one, so that the others stay spread.
  auto nearest = std::lower_bound(chosen.begin(), chosen.end(), index);
  if (nearest != chosen.begin() && index - *(nearest - 1) < *nearest - index) --nearest;
  *nearest = index;
  return chosen;
}

CalibrationFrames write_calibration_frames(const std::filesystem::path& folder,
                                           const CalibrationReport& report, std::size_t camera,
                                           const CalibrationCoverage& coverage) {
  CalibratedRobot calibrated(*report.calibration_data, *report.result, camera);
  const std::vector<std::size_t> drawn = frames_to_draw(calibrated.source(), coverage);
  const FrameWriter writer(folder, camera, calibrated);
  CalibrationFrames frames;
  for (std::size_t k = 0; k < calibrated.source().frames.size(); ++k) {
    const std::optional<Side> before = take(calibrated, k, CalibrationSide::before);
    const std::optional<Side> after = take(calibrated, k, CalibrationSide::after);
    if (before) frames.before.add(before->residual_m);
    if (after) frames.after.add(after->residual_m);
    if (std::find(drawn.begin(), drawn.end(), k) == drawn.end()) continue;
    const bool has_moved = calibrated.found().refused.empty();
    frames.pictures.push_back(writer.write(k, before, has_moved ? after : std::nullopt));
  }
  return frames;
}

}  // namespace berth::app
