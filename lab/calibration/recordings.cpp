#include "lab/calibration/recordings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "lab/calibration/judge.hpp"
#include "sim/sensor_model.hpp"

namespace berth::lab {

void measure_recording(const std::filesystem::path& folder, const StartErrors& errors, int starts) {
  const SceneFile given = read_scene(folder / "scene.yaml");
  const Calibrated reference = calibration_data(given);
  const CameraCalibration& camera = reference.found.cameras[0];
  fmt::print("\n## {}\n\nas given: {}\n", folder.filename().string(),
             text_of(judge(given, folder)));
  fmt::print(
      "calibrated from the given pose: robot moved {:.1f} mm, halves {:.1f} mm, agreement "
      "{:.3f} -> {:.3f}, {:.2f} s\n",
      1000 * camera.moved_m, 1000 * camera.halves_m, camera.score_before, camera.score_after,
      reference.time_s);
  for (const auto* list : {&reference.proposal.self_filter, &reference.proposal.sensor}) {
    for (const ProposedSetting& one : *list) {
      fmt::print("{} = {:g}: {}\n", one.key, one.value, one.why);
    }
  }
  fmt::print(
      "readings lie {:.0f} mm behind the model; {} pixels left near the robot, {} at most in "
      "one blob; a rod of 1 cm is kept from {:.0f} mm\n",
      1000 * reference.proposal.bias_m, reference.proposal.leftover_px,
      reference.proposal.largest_leftover_px, 1000 * reference.proposal.rod_gap_m);
  for (const SmallestObstacle& one : reference.proposal.smallest) {
    fmt::print("at {} m: rod {:.0f} mm, finger {:.0f} mm\n", one.depth_m, 1000 * one.rod_width_m,
               1000 * one.finger_width_m);
  }
  fmt::print("with these: {}\n", text_of(judge(with_result(given, reference), folder)));
  int back = 0;
  double slowest_s = 0;
  double farthest_m = 0;
  for (int i = 1; i <= starts; ++i) {
    SceneFile off = given;
    Pose& X_PC = off.cameras[0].X_PC;
    X_PC = sim::miscalibrated(X_PC, errors.offset_m, errors.angle_deg * std::numbers::pi / 180,
                              static_cast<std::uint32_t>(i));
    const Calibrated calibrated = calibration_data(off);
    const double length_m =
        apart_m(calibrated.found.cameras[0].X_PC, camera.X_PC, errors.robot_depth_m);
    const bool is_back = length_m < 0.005;
    back += is_back;
    slowest_s = std::max(slowest_s, calibrated.time_s);
    farthest_m = std::max(farthest_m, length_m);
    if (!is_back || i <= errors.judged) {
      fmt::print("start {}: {:.1f} mm from the reference, {}\n", i, 1000 * length_m,
                 text_of(judge(with_result(off, calibrated), folder)));
    }
    std::fflush(stdout);
  }
  fmt::print(
      "{} of {} starts {:.0f} cm and {:.0f} degrees off came back, {:.2f} mm off at most, "
      "{:.1f} s at most\n",
      back, starts, 100 * errors.offset_m, errors.angle_deg, 1000 * farthest_m, slowest_s);
}

}  // namespace berth::lab
