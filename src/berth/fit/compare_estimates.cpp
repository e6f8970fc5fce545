#include "berth/fit/compare_estimates.hpp"

#include <cmath>
#include <limits>
#include <mutex>

#include "berth/fit/robot_pixels.hpp"

namespace berth {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Sums of each frame, since frames are drawn side by side; the means do not depend on their order.
class CameraMeans {
 public:
  explicit CameraMeans(const CalibrationData& calibration_data) {
    for (const CalibrationCamera* camera : calibration_data.cameras) {
      sums_.emplace_back(camera->frames.size());
    }
  }
  void add(const DrawnFrame& drawn, double value) {
    Sum& sum = sums_[drawn.camera_index][drawn.frame_index];
    sum.value += value;
    sum.count += 1;
  }
  std::vector<double> all() const {
    std::vector<double> means;
    for (const std::vector<Sum>& camera : sums_) {
      Sum all;
      for (const Sum& sum : camera) {
        all.value += sum.value;
        all.count += sum.count;
      }
      means.push_back(all.count > 0 ? all.value / all.count : kUnknown);
    }
    return means;
  }

 private:
  struct Sum {
    double value = 0;
    double count = 0;
  };
  std::vector<std::vector<Sum>> sums_;
};

}  // namespace

std::vector<double> displacement_m(FrameDrawer& drawer, int step, const CalibrationEstimate& a,
                                   const CalibrationEstimate& b) {
  const CalibrationData& calibration_data = drawer.calibration_data();
  CameraMeans means(calibration_data);
  drawer.draw(step, a, {}, FrameChoice::all, [&](const DrawnFrame& drawn) {
    const CalibrationFrame& frame =
        calibration_data.cameras[drawn.camera_index]->frames[drawn.frame_index];
    const auto other = pose_robot(calibration_data, drawn.camera_index, frame, b, {});
    if (!other) return;
    std::vector<Pose> X_CC(calibration_data.model->links.size());
    for (std::size_t i = 0; i < X_CC.size(); ++i) {
      X_CC[i] = other->X_BC.inverse() * other->pose.X_BL[i] * drawn.posed.pose.X_BL[i].inverse() *
                drawn.posed.X_BC;
    }
    each_robot_pixel(drawn.camera, drawn.robot, [&](int u, int v, LinkId id) {
      const Eigen::Vector3d p_C_m = point_at(drawn.camera, u, v, drawn.robot.depth_m(u, v));
      means.add(drawn,
                (X_CC[calibration_data.model->evaluated_links[id - 1]] * p_C_m - p_C_m).norm());
    });
  });
  return means.all();
}

std::vector<double> robot_depth_m(FrameDrawer& drawer, int step,
                                  const CalibrationEstimate& estimate) {
  CameraMeans means(drawer.calibration_data());
  drawer.draw(step, estimate, {}, FrameChoice::all, [&](const DrawnFrame& drawn) {
    each_robot_pixel(drawn.camera, drawn.robot,
                     [&](int u, int v, LinkId) { means.add(drawn, drawn.robot.depth_m(u, v)); });
  });
  return means.all();
}

std::vector<ResidualSpread> residuals(FrameDrawer& drawer, const CalibrationEstimate& estimate) {
  std::vector<std::vector<float>> lengths(drawer.calibration_data().cameras.size());
  std::mutex mutex;
  drawer.draw(1, estimate, {}, FrameChoice::all, [&](const DrawnFrame& drawn) {
    std::vector<float> found;
    const CameraEstimate& camera = estimate.cameras[drawn.camera_index];
    each_robot_pixel(drawn.camera, drawn.robot, [&](int u, int v, LinkId) {
      const float off_m =
          std::abs(camera.corrected(drawn.depth_m(u, v)) - drawn.robot.depth_m(u, v));
      if (off_m < kRobotLike_m) found.push_back(off_m);
    });
    const std::lock_guard lock(mutex);
    std::vector<float>& all = lengths[drawn.camera_index];
    all.insert(all.end(), found.begin(), found.end());
  });
  std::vector<ResidualSpread> spreads;
  for (std::vector<float>& camera : lengths) {
    spreads.push_back({quantile(camera, 0.5), quantile(camera, 0.9), quantile(camera, 0.99)});
  }
  return spreads;
}

}  // namespace berth
