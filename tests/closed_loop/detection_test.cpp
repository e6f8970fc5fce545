// What the cell's cameras detect is what the monitor is told.
#include <gtest/gtest.h>

#include "berth/calibration/drawn_ball.hpp"
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
    const Eigen::Vector3d center_B = draw_center();
    const std::vector<Frame> frames = take_frames(center_B);
    std::vector<const Frame*> all;
    for (const Frame& frame : frames) all.push_back(&frame);
    FrameSet set;
    set.assign(all, {});
    if (has_reading(frames, center_B)) return true;
    for (int i = 0; i < 200; ++i) {
      if (set.space().hiding_pixel(center_B + radius_m_ * sim::draw_point(random_, 1).normalized()))
        return true;
    }
    return false;
  }

  /// As near to the arm as matters, and not at its surface, where the self filter's padding is. The
  /// arm goes to another pose.
  Eigen::Vector3d draw_center() {
    joints_ = {0, path_at(random_(0, 1) * cycle_s()).position_rad};
    forward_kinematics(model_, joints_.position, pose_);
    constexpr double kNear_m = 0.08, kFar_m = 0.6;
    while (true) {
      const double range_m = random_(0.1, 1), angle_rad = random_(-3.14, 3.14);
      Pose X_BP = Pose::Identity();
      X_BP.translation() << range_m * std::cos(angle_rad), range_m * std::sin(angle_rad),
          random_(0, 1.1);
      const double clearance_m = clearance_.at(pose_, {X_BP});
      if (clearance_m > kNear_m && clearance_m < kFar_m) return X_BP.translation();
    }
  }

  /// Of the arm where it is, and a ball there.
  std::vector<Frame> take_frames(const Eigen::Vector3d& center_B) {
    std::vector<Frame> frames(observers_.size());
    Pose X_BP = Pose::Identity();
    X_BP.translation() = center_B;
    for (std::size_t c = 0; c < frames.size(); ++c) {
      depth_m_[c] = sensors_.take_image(static_cast<int>(c), pose_, {X_BP});
      observers_[c]->observe(depth_m_[c], joints_, frames[c]);
    }
    return frames;
  }

  /// One image of each camera, as a map of detection wants them: no ball is there.
  std::vector<DetectionImage> take_empty_images() {
    std::vector<DetectionImage> images;
    for (Frame& frame : take_frames(Eigen::Vector3d(0, 0, -5))) {
      images.push_back({depth_m_[images.size()], frame.robot, frame.X_BC});
    }
    return images;
  }

  bool has_reading(const std::vector<Frame>& frames, const Eigen::Vector3d& center_B) const {
    return std::ranges::any_of(frames,
                               [&](const Frame& frame) { return has_reading(frame, center_B); });
  }

 private:
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
  std::array<DepthImage, 3> depth_m_;
  JointState joints_;
  RobotPose pose_;
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

/// What calibration's map says of the same cameras, by ten poses of the arm.
DetectionMap map_of_cell() {
  std::vector<DetectionCamera> cameras;
  for (const auto& view : cell_views(cell_robot(), {0, 1, 2}, kCellDetection_m)) {
    cameras.push_back({view->camera(), view->settings().self_filter, view->settings().sensor, {}});
  }
  DrawnBalls balls(kCellDetection_m);
  for (int i = 0; i < 10; ++i) {
    balls.draw_center();
    std::vector<DetectionImage> images = balls.take_empty_images();
    for (std::size_t c = 0; c < 3; ++c) cameras[c].images.push_back(std::move(images[c]));
  }
  return measure_detection(cameras, robot_reach(cell_model()), [] {});
}

double least_near_m(const DetectionMap& map, const Eigen::Vector3d& at_B_m) {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < map.places_B_m.size(); ++i) {
    const auto off_m = [&](std::size_t k) { return (map.places_B_m[k] - at_B_m).norm(); };
    if (off_m(i) < off_m(nearest)) nearest = i;
  }
  return map.cell.least_m[nearest];
}

/// Whether enough of it is in view for the map to count it.
bool is_in_view(const std::vector<DetectionImage>& images, const Eigen::Vector3d& center_B,
                double radius_m) {
  const std::vector<CellCamera> cameras = cell_cameras();
  bool is_seen = false;
  for (std::size_t c = 0; c < images.size(); ++c) {
    const BallPlace place = ball_at(cameras[c].camera, images[c], center_B, radius_m);
    if (!place.is_possible) return false;
    is_seen = is_seen || place.ball.has_value();
  }
  return is_seen;
}

// The map draws balls with the noise that an image has; here they are cast with the sensor model,
// mixed pixels among it.
TEST(DetectionMapOfTheCell, SaysOfWhichBallsAReadingIsLeft) {
  const DetectionMap map = map_of_cell();
  for (const double diameter_m : {0.02, 0.03}) {
    DrawnBalls balls(diameter_m);
    int promised = 0, left = 0;
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d center_B = balls.draw_center();
      if (!(least_near_m(map, center_B) <= diameter_m)) continue;
      if (!is_in_view(balls.take_empty_images(), center_B, diameter_m / 2)) continue;
      ++promised;
      left += balls.has_reading(balls.take_frames(center_B), center_B);
    }
    EXPECT_GE(promised, 30) << diameter_m;
    EXPECT_GE(left, promised * 97 / 100) << diameter_m;
  }
}

}  // namespace
}  // namespace berth::lab
