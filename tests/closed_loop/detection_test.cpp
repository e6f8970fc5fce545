// What the cell's cameras detect is what the monitor is told.
#include <gtest/gtest.h>

#include "berth/fit/robot_pixels.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "lab/closed_loop/cell_sensors.hpp"
#include "lab/closed_loop/path.hpp"
#include "sim/random.hpp"
#include "sim/shapes.hpp"
#include "sim/true_clearance.hpp"

namespace berth::lab {
namespace {

/// A ball at drawn places around the arm, and three images of each.
class DrawnBalls {
 public:
  explicit DrawnBalls(double diameter_m)
      : radius_m_(diameter_m / 2),
        model_(cell_model()),
        meshes_{sim::make_ellipsoid(Eigen::Vector3d::Constant(radius_m_), 16)},
        sensors_(model_, meshes_, 7),
        clearance_(model_, meshes_) {
    for (const auto& view : cell_views(cell_robot(), {0, 1, 2}, diameter_m)) {
      observers_.push_back(std::make_unique<Observer>(view));
    }
  }

  /// Whether a reading lies at the ball, or something of it is hidden.
  bool is_next_told() {
    const JointState joints{0, path_at(random_(0, 1) * cycle_s()).position_rad};
    RobotPose pose;
    forward_kinematics(model_, joints.position, pose);
    const Eigen::Vector3d center_B = draw_center(pose);
    std::vector<Frame> frames(observers_.size());
    std::vector<const Frame*> all;
    Pose X_BP = Pose::Identity();
    X_BP.translation() = center_B;
    for (std::size_t c = 0; c < frames.size(); ++c) {
      const DepthImage depth_m = sensors_.take_image(static_cast<int>(c), pose, {X_BP});
      observers_[c]->observe(depth_m, joints, frames[c]);
      all.push_back(&frames[c]);
    }
    FrameSet set;
    set.assign(all, {});
    for (const Frame& frame : frames) {
      if (has_reading(frame, center_B)) return true;
    }
    for (int i = 0; i < 200; ++i) {
      if (set.space().hiding_pixel(center_B + radius_m_ * sim::draw_point(random_, 1).normalized()))
        return true;
    }
    return false;
  }

 private:
  /// As near to the arm as matters, and not at its surface, where the self filter's padding is.
  Eigen::Vector3d draw_center(const RobotPose& pose) {
    constexpr double kNear_m = 0.08, kFar_m = 0.6;
    while (true) {
      const double range_m = random_(0.1, 1), angle_rad = random_(-3.14, 3.14);
      Pose X_BP = Pose::Identity();
      X_BP.translation() << range_m * std::cos(angle_rad), range_m * std::sin(angle_rad),
          random_(0, 1.1);
      const double clearance_m = clearance_.at(pose, {X_BP});
      if (clearance_m > kNear_m && clearance_m < kFar_m) return X_BP.translation();
    }
  }

  bool has_reading(const Frame& frame, const Eigen::Vector3d& center_B) const {
    const Camera& camera = frame.view->camera();
    const Pose X_CB = frame.X_BC.inverse();
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const float depth_m = frame.obstacles.depth_m(u, v);
        if (!std::isfinite(depth_m)) continue;
        const Eigen::Vector3d p_C = point_at(camera, u, v, depth_m);
        if ((p_C - X_CB * center_B).norm() < radius_m_ + kCellReadingError_m) return true;
      }
    }
    return false;
  }

  double radius_m_;
  RobotModel model_;
  std::vector<TriangleMesh> meshes_;
  CellSensors sensors_;
  sim::TrueClearance clearance_;
  std::vector<std::unique_ptr<Observer>> observers_;
  sim::Random random_{99};
};

class Detection : public ::testing::TestWithParam<double> {};

// The rest stands behind the arm for each camera, or lost its few pixels to noise in this one
// image.
TEST_P(Detection, AlmostAllBallsOfThisDiameterAreTold) {
  DrawnBalls balls(GetParam());
  constexpr int kBalls = 150;
  int told = 0;
  for (int i = 0; i < kBalls; ++i) told += balls.is_next_told();
  EXPECT_GE(told, kBalls * 97 / 100);
}

INSTANTIATE_TEST_SUITE_P(OfTheCell, Detection,
                         ::testing::Values(0.02, kCellDetection_m, 0.03, 0.04));

// Else the test above could not fail.
TEST(UndetectedBalls, MuchSmallerBallsAreNotTold) {
  DrawnBalls balls(0.005);
  int told = 0;
  for (int i = 0; i < 50; ++i) told += balls.is_next_told();
  EXPECT_LT(told, 40);
}

}  // namespace
}  // namespace berth::lab
