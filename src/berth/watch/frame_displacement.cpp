#include "berth/watch/frame_displacement.hpp"

#include <algorithm>

#include "berth/fit/compare_estimates.hpp"
#include "berth/fit/fit.hpp"
#include "berth/fit/score.hpp"

namespace berth {
namespace {

/// Fewer pixels of the robot, at every second pixel of every second row, tell no pose.
constexpr double kLeastPixels = 300;
/// The depth's error was learnt at calibration: one frame shows less of it.
constexpr double kBiasDeviation_m = 0.002;
constexpr double kScaleDeviation = 0.002;
constexpr ScoreSettings kJudge{2, 0.03, 10};
/// Of the agreement. A camera that was bumped gains 0.09 and more by the fit; what hides the arm
/// pulls at the fit as well, but gains nothing (bundled scene; docs/calibration.md).
constexpr double kLeastGainOfScore = 0.04;
/// A camera that was bumped is off by centimetres; one that is off by more is found by T.
const std::vector<FitRound> kRounds{{4, 6, 0.10, 0.08, 48, 0.08}, {2, 5, 0.05, 0.04, 24, 0.06}};

}  // namespace

FrameDisplacement::FrameDisplacement(const RobotModel& model,
                                     std::shared_ptr<const LinkMeshes> meshes, const Camera& camera,
                                     std::size_t parent, const Pose& X_PC, double bias_m)
    : model_(&model),
      meshes_(std::move(meshes)),
      camera_(camera),
      parent_(parent),
      X_PC_(X_PC),
      bias_m_(bias_m) {}

std::optional<double> FrameDisplacement::measure(DepthView depth_m, const JointState& joints,
                                                 const std::stop_token& stop) const {
  CalibrationCamera camera;
  camera.camera = camera_;
  camera.parent = parent_;
  camera.X_PC = X_PC_;
  CalibrationFrame& frame = camera.frames.emplace_back();
  frame.joints = joints;
  frame.depth_m.resize(depth_m.width, depth_m.height, kNoDepth);
  for (int v = 0; v < depth_m.height; ++v) {
    std::copy_n(depth_m.row(v), depth_m.width, frame.depth_m.row(v));
  }
  const CalibrationData one{model_, meshes_, nullptr, {&camera}};
  FrameDrawer drawer(one, {4, 2});
  CalibrationEstimate start = start_of(one);
  start.cameras[0].depth_offset_m = -bias_m_;
  const Score at_start = score(drawer, start, kJudge);
  if (at_start.pixels < kLeastPixels || stop.stop_requested()) return {};
  FitPriors priors;
  priors.depth_offset_m = kBiasDeviation_m;
  priors.depth_scale = kScaleDeviation;
  priors.expected_depth_offset_m = -bias_m_;
  const CalibrationEstimate fitted = fit(drawer, start, priors, kRounds).estimate;
  if (score(drawer, fitted, kJudge).value < at_start.value + kLeastGainOfScore) return 0;
  return displacement_m(drawer, 4, start, fitted)[0];
}

}  // namespace berth
