// What the cell's cameras detect is what the monitor is told.
#include <gtest/gtest.h>

#include "berth/calibration/drawn_ball.hpp"
#include "berth/fit/robot_pixels.hpp"
#include "berth/pipeline/frame_set.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/robot/primitives.hpp"
#include "lab/closed_loop/cell_sensors.hpp"
#include "lab/closed_loop/path.hpp"
#include "sim/random.hpp"
#include "sim/shapes.hpp"
#include "sim/true_clearance.hpp"
#include "sim/turn_between.hpp"

namespace berth::lab {
namespace {

/// A ball or a rod at drawn places around the arm, and three images of each.
class DrawnThings {
 public:
  /// A length of 0 makes it a ball.
  explicit DrawnThings(double diameter_m, double length_m = 0)
      : radius_m_(diameter_m / 2),
        length_m_(length_m),
        model_(cell_model()),
        meshes_{length_m > 0 ? make_cylinder(radius_m_, length_m)
                             : sim::make_ellipsoid(Eigen::Vector3d::Constant(radius_m_), 16)},
        sensors_(model_, meshes_, 7),
        clearance_(model_, meshes_) {
    for (const auto& mounted : mounted_cell_cameras(cell_robot(), {0, 1, 2}, diameter_m)) {
      observers_.push_back(std::make_unique<Observer>(mounted));
    }
  }

  /// Whether a reading lies at the ball, or something of it is hidden.
  bool is_next_told() {
    const Pose X_BP = draw_place();
    std::vector<Frame> frames(observers_.size());
    std::vector<const Frame*> all;
    for (std::size_t c = 0; c < frames.size(); ++c) {
      take_frame(c, X_BP, frames[c]);
      if (has_reading(frames[c], X_BP)) return true;
      all.push_back(&frames[c]);
    }
    FrameSet set;
    set.assign(all, {});
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3d on_ball = radius_m_ * sim::draw_point(random_, 1).normalized();
      if (set.space().hiding_pixel(X_BP.translation() + on_ball)) return true;
    }
    return false;
  }

  /// As near to the arm as matters, and not at its surface, where the self filter's padding is. The
  /// arm goes to another pose.
  Pose draw_place() {
    joints_ = {0, path_at(random_(0, 1) * cycle_s()).position_rad};
    forward_kinematics(model_, joints_.position, pose_);
    constexpr double kNear_m = 0.08, kFar_m = 0.6;
    while (true) {
      const double range_m = random_(0.1, 1), angle_rad = random_(-3.14, 3.14);
      Pose X_BP = Pose::Identity();
      if (length_m_ > 0) {
        X_BP = Pose(sim::turn_between(Eigen::Vector3d::UnitZ(), sim::draw_point(random_, 1)));
      }
      X_BP.translation() << range_m * std::cos(angle_rad), range_m * std::sin(angle_rad),
          random_(0, 1.1);
      const double clearance_m = clearance_.at(pose_, {X_BP});
      if (clearance_m > kNear_m && clearance_m < kFar_m) return X_BP;
    }
  }

  /// One image of each camera, as a map of detection wants them: nothing is there.
  std::vector<DetectionImage> take_empty_images() {
    std::vector<DetectionImage> images;
    for (std::size_t c = 0; c < observers_.size(); ++c) {
      Frame frame;
      take_frame(c, Pose(Eigen::Translation3d(0, 0, -5)), frame);
      images.push_back({depth_m_, frame.robot, frame.X_BC});
    }
    return images;
  }

  /// Of any camera, each of which takes an image until one has one.
  bool is_reading_left(const Pose& X_BP) {
    for (std::size_t c = 0; c < observers_.size(); ++c) {
      Frame frame;
      take_frame(c, X_BP, frame);
      if (has_reading(frame, X_BP)) return true;
    }
    return false;
  }

 private:
  /// Of the arm where it is, and the thing there.
  void take_frame(std::size_t camera, const Pose& X_BP, Frame& frame) {
    depth_m_ = sensors_.take_image(static_cast<int>(camera), pose_, {X_BP});
    observers_[camera]->observe(depth_m_, joints_, frame);
  }

  /// From the ball's centre or the rod's axis.
  double off_m(Eigen::Vector3d p_P) const {
    p_P.z() -= std::clamp(p_P.z(), -length_m_ / 2, length_m_ / 2);
    return p_P.norm();
  }

  bool has_reading(const Frame& frame, const Pose& X_BP) const {
    const Camera& camera = frame.mounted->camera();
    const Pose X_PC = X_BP.inverse() * frame.X_BC;
    for (int v = 0; v < camera.height_px; ++v) {
      for (int u = 0; u < camera.width_px; ++u) {
        const float depth_m = frame.obstacles.depth_m(u, v);
        if (!std::isfinite(depth_m)) continue;
        if (off_m(X_PC * point_at(camera, u, v, depth_m)) < radius_m_ + kCellReadingError_m) {
          return true;
        }
      }
    }
    return false;
  }

  double radius_m_;
  double length_m_;
  RobotModel model_;
  std::vector<TriangleMesh> meshes_;
  CellSensors sensors_;
  sim::TrueClearance clearance_;
  std::vector<std::unique_ptr<Observer>> observers_;
  DepthImage depth_m_;
  JointState joints_;
  RobotPose pose_;
  sim::Random random_{99};
};

class Detection : public ::testing::TestWithParam<double> {};

// The rest stands behind the arm for each camera, or lost its few pixels to noise in this one
// image.
TEST_P(Detection, AlmostAllBallsOfThisDiameterAreTold) {
  DrawnThings balls(GetParam());
  constexpr int kBalls = 150;
  int told = 0;
  for (int i = 0; i < kBalls; ++i) told += balls.is_next_told();
  EXPECT_GE(told, kBalls * 97 / 100);
}

INSTANTIATE_TEST_SUITE_P(OfTheCell, Detection,
                         ::testing::Values(0.014, kCellDetection_m, 0.03, 0.04));

// Else the test above could not fail.
TEST(UndetectedBalls, MuchSmallerBallsAreNotTold) {
  DrawnThings balls(0.005);
  int told = 0;
  for (int i = 0; i < 50; ++i) told += balls.is_next_told();
  EXPECT_LT(told, 40);
}

/// What calibration's map says of the same cameras, by ten poses of the arm.
DetectionMap map_of_cell() {
  std::vector<DetectionCamera> cameras;
  for (const auto& mounted : mounted_cell_cameras(cell_robot(), {0, 1, 2}, kCellDetection_m)) {
    cameras.push_back(
        {mounted->camera(), mounted->settings().self_filter, mounted->settings().sensor, {}});
  }
  DrawnThings balls(kCellDetection_m);
  for (int i = 0; i < 10; ++i) {
    balls.draw_place();
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
class DetectionMapOfTheCell : public ::testing::Test {
 protected:
  /// Where the map says that a ball of this diameter is detected, so is what holds such a ball.
  void expect_readings_of(DrawnThings things, double diameter_m) const {
    int promised = 0, left = 0;
    for (int i = 0; i < 60; ++i) {
      const Pose X_BP = things.draw_place();
      const Eigen::Vector3d center_B = X_BP.translation();
      if (!(least_near_m(map_, center_B) <= diameter_m)) continue;
      if (!is_in_view(things.take_empty_images(), center_B, diameter_m / 2)) continue;
      ++promised;
      left += things.is_reading_left(X_BP);
    }
    EXPECT_GE(promised, 20) << diameter_m;
    EXPECT_GE(left, promised * 97 / 100) << diameter_m;
  }

 private:
  const DetectionMap map_ = map_of_cell();
};

// A rod is as thin as the ball, in any direction.
TEST_F(DetectionMapOfTheCell, SaysOfWhichBallsAndRodsAReadingIsLeft) {
  constexpr double kBall = 0, kRod_m = 0.2;
  for (const double diameter_m : {0.02, 0.03}) {
    for (const double length_m : {kBall, kRod_m}) {
      expect_readings_of(DrawnThings(diameter_m, length_m), diameter_m);
    }
  }
}

}  // namespace
}  // namespace berth::lab
