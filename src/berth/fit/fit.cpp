#include "berth/fit/fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "berth/fit/fit_rows.hpp"
#include "berth/fit/robot_pixels.hpp"

namespace berth {
namespace {

/// Of one reading at 1 m, across the surface; grows with the square of the depth.
constexpr double kDepthDeviation_m = 0.005;
/// Neighbouring readings err alike: one in this number of pixels counts.
constexpr double kDepthPixelsPerRow = 100;
/// Of an outline: pixels, and what meshes leave out.
constexpr double kOutlineDeviation_px = 1;
constexpr double kOutlineDeviation_m = 0.001;
constexpr double kOutlinePixelsPerRow = 4;
/// More in one iteration is a jump into the unknown.
constexpr double kMostTurn_rad = 0.1;
constexpr double kMostMove_m = 0.1;
/// About how many depth rows a frame gives.
constexpr double kDepthRows = 4000;

double tukey(double residual_m, double cut_m) {
  const double ratio = residual_m / cut_m;
  const double rest = 1 - ratio * ratio;
  return rest > 0 ? rest * rest : 0;
}

/// Normal equations of all unknowns.
struct Equations {
  Eigen::MatrixXd information;
  Eigen::VectorXd gradient;

  explicit Equations(Eigen::Index unknowns)
      : information(Eigen::MatrixXd::Zero(unknowns, unknowns)),
        gradient(Eigen::VectorXd::Zero(unknowns)) {}
};

class Fit {
 public:
  Fit(FrameDrawer& drawer, const CalibrationEstimate& start, const FitPriors& priors,
      FrameChoice choice)
      : drawer_(drawer), start_(start), priors_(priors), choice_(choice) {
    result_.estimate = start;
    cameras_ = static_cast<Eigen::Index>(start.cameras.size());
    joints_ = static_cast<Eigen::Index>(priors.joints.size());
  }

  FitResult run(const std::vector<FitRound>& rounds) {
    find_pivots(rounds.front().step);
    for (const FitRound& round : rounds) {
      for (int i = 0; i < round.iterations; ++i) {
        const Equations equations = build(round);
        result_.information = equations.information;
        if (apply(equations.information.ldlt().solve(-equations.gradient)) < 1e-6) break;
      }
    }
    return std::move(result_);
  }

 private:
  Eigen::Index unknowns() const { return cameras_ * kCameraUnknowns + joints_; }

  /// The middle of what each camera sees of the robot. Added up in the frames' order, so that it
  /// does not depend on threads.
  void find_pivots(int step) {
    result_.pivot_C_m.assign(start_.cameras.size(), Eigen::Vector3d(0, 0, 1));
    std::vector<std::vector<Eigen::Vector4d>> parts(start_.cameras.size());
    for (std::size_t c = 0; c < parts.size(); ++c) {
      parts[c].assign(drawer_.calibration_data().cameras[c]->frames.size(),
                      Eigen::Vector4d::Zero());
    }
    drawer_.draw(step, start_, {}, choice_, [&](const DrawnFrame& drawn) {
      Eigen::Vector4d& sum = parts[drawn.camera_index][drawn.frame_index];
      const auto add = [&](int u, int v, LinkId) {
        sum += point_at(drawn.camera, u, v, drawn.robot.depth_m(u, v)).homogeneous();
      };
      each_robot_pixel(drawn.camera, drawn.robot, add, 2);
    });
    for (std::size_t c = 0; c < parts.size(); ++c) {
      Eigen::Vector4d sum = Eigen::Vector4d::Zero();
      for (const Eigen::Vector4d& part : parts[c]) sum += part;
      if (sum.w() > 0) result_.pivot_C_m[c] = sum.head<3>() / sum.w();
    }
  }

  /// Frame by frame, then added up in their order, so that the sum does not depend on threads.
  Equations build(const FitRound& round) {
    std::vector<std::vector<Equations>> parts(start_.cameras.size());
    for (std::size_t c = 0; c < parts.size(); ++c) {
      parts[c].assign(drawer_.calibration_data().cameras[c]->frames.size(), Equations(0));
    }
    const PosedRobotRequest request{joints_ > 0, priors_.clock_s > 0};
    drawer_.draw(round.step, result_.estimate, request, choice_, [&](const DrawnFrame& drawn) {
      parts[drawn.camera_index][drawn.frame_index] = equations_of(drawn, round);
    });
    Equations sum(unknowns());
    add_priors(sum);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const auto first = static_cast<Eigen::Index>(c) * kCameraUnknowns;
      for (const Equations& part : parts[c]) {
        if (part.gradient.size() == 0) continue;
        add(part, first, sum);
      }
    }
    return sum;
  }

  /// `part` holds the unknowns of one camera, then those of the joints.
  void add(const Equations& part, Eigen::Index first, Equations& sum) const {
    const Eigen::Index n = kCameraUnknowns;
    const Eigen::Index joint = cameras_ * n;
    sum.gradient.segment(first, n) += part.gradient.head(n);
    sum.information.block(first, first, n, n) += part.information.topLeftCorner(n, n);
    if (joints_ == 0) return;
    sum.gradient.tail(joints_) += part.gradient.tail(joints_);
    sum.information.block(joint, joint, joints_, joints_) +=
        part.information.bottomRightCorner(joints_, joints_);
    sum.information.block(first, joint, n, joints_) += part.information.topRightCorner(n, joints_);
    sum.information.block(joint, first, joints_, n) +=
        part.information.bottomLeftCorner(joints_, n);
  }

  void add_priors(Equations& sum) const {
    const auto add_prior = [&](Eigen::Index unknown, double moved, double deviation) {
      // An unknown that is not fitted is held where it is.
      const double weight = 1 / std::pow(deviation > 0 ? deviation : 1e-9, 2);
      sum.information(unknown, unknown) += weight;
      sum.gradient(unknown) += weight * moved;
    };
    for (Eigen::Index c = 0; c < cameras_; ++c) {
      const CameraEstimate& now = result_.estimate.cameras[c];
      const CameraEstimate& start = start_.cameras[c];
      const Eigen::Index first = c * kCameraUnknowns;
      // Wide: where a camera sees too little for a pose, the equations can still be solved.
      for (int i = 0; i < 3; ++i) add_prior(first + kRotation + i, 0, 1);
      for (int i = 0; i < 3; ++i) add_prior(first + kMove + i, 0, 1);
      add_prior(first + kDepthOffset, now.depth_offset_m - priors_.expected_depth_offset_m,
                priors_.depth_offset_m);
      add_prior(first + kDepthScale, now.depth_scale - 1, priors_.depth_scale);
      add_prior(first + kDilation, now.dilation_px, priors_.dilation_px);
      add_prior(first + kClock, now.clock_shift_s - start.clock_shift_s, priors_.clock_s);
    }
    for (Eigen::Index j = 0; j < joints_; ++j) {
      add_prior(cameras_ * kCameraUnknowns + j,
                result_.estimate.joint_shift[j] - start_.joint_shift[j], priors_.joints[j]);
    }
  }

  Equations equations_of(const DrawnFrame& drawn, const FitRound& round) const {
    const CameraEstimate& estimate = result_.estimate.cameras[drawn.camera_index];
    Equations equations(kCameraUnknowns + joints_);
    std::vector<FitRow> rows;
    const double pixels = static_cast<double>(drawn.camera.width_px) * drawn.camera.height_px;
    const int stride = std::max(1, static_cast<int>(std::sqrt(pixels / 10 / kDepthRows)));
    append_depth_rows(drawn.camera, drawn.depth_m, drawn.robot, estimate,
                      {stride, round.depth_cut_m}, rows);
    const double depth_count = std::pow(stride * drawn.step, 2) / kDepthPixelsPerRow;
    for (const FitRow& row : rows) {
      const double z_m = row.p_C_m.z();
      const double deviation_m = kDepthDeviation_m * std::max(1.0, z_m * z_m);
      add_row(drawn, row,
              depth_count / (deviation_m * deviation_m) * tukey(row.residual_m, round.depth_cut_m),
              equations);
    }
    rows.clear();
    const int reach = std::max(2, round.outline_reach_px / drawn.step);
    append_outline_rows(drawn.camera, drawn.depth_m, drawn.robot, estimate, drawn.step,
                        {reach, round.outline_band_m}, rows);
    const double outline_count = drawn.step / kOutlinePixelsPerRow;
    for (const FitRow& row : rows) {
      const double deviation_m =
          kOutlineDeviation_m + kOutlineDeviation_px * std::max(1.0, 0.5 * drawn.step) *
                                    row.p_C_m.z() / (drawn.camera.fx_px * drawn.step);
      add_row(
          drawn, row,
          outline_count / (deviation_m * deviation_m) * tukey(row.residual_m, round.outline_cut_m),
          equations);
    }
    return equations;
  }

  void add_row(const DrawnFrame& drawn, const FitRow& row, double weight,
               Equations& equations) const {
    if (weight == 0) return;
    const std::size_t link = drawer_.calibration_data().model->evaluated_links[row.link - 1];
    Eigen::VectorXd by(kCameraUnknowns + joints_);
    const Eigen::Vector3d arm = row.p_C_m - result_.pivot_C_m[drawn.camera_index];
    by.segment<3>(kRotation) = arm.cross(row.per_move);
    by.segment<3>(kMove) = row.per_move;
    by[kDepthOffset] = row.per_depth_offset;
    by[kDepthScale] = row.per_depth_scale;
    by[kDilation] = row.per_dilation;
    by[kClock] =
        priors_.clock_s > 0 ? row.per_move.dot(drawn.posed.per_second[link].at(row.p_C_m)) : 0;
    for (Eigen::Index j = 0; j < joints_; ++j) {
      by[kCameraUnknowns + j] = row.per_move.dot(drawn.posed.per_joint[link][j].at(row.p_C_m));
    }
    equations.information.noalias() += weight * by * by.transpose();
    equations.gradient += weight * row.residual_m * by;
  }

  /// How far the farthest unknown went, in m or rad.
  double apply(Eigen::VectorXd change) {
    double farthest = 0;
    for (Eigen::Index c = 0; c < cameras_; ++c) {
      CameraEstimate& camera = result_.estimate.cameras[c];
      auto part = change.segment<kCameraUnknowns>(c * kCameraUnknowns);
      const double turn = part.segment<3>(kRotation).norm();
      const double move = part.segment<3>(kMove).norm();
      const double shrink = std::min(
          {1.0, kMostTurn_rad / std::max(turn, 1e-12), kMostMove_m / std::max(move, 1e-12)});
      part *= shrink;
      farthest = std::max({farthest, shrink * turn, shrink * move});
      move_robot(part.segment<3>(kRotation), part.segment<3>(kMove), result_.pivot_C_m[c], camera);
      camera.depth_offset_m += part[kDepthOffset];
      camera.depth_scale += part[kDepthScale];
      camera.dilation_px += part[kDilation];
      camera.clock_shift_s += part[kClock];
    }
    for (Eigen::Index j = 0; j < joints_; ++j) {
      const double moved = change[cameras_ * kCameraUnknowns + j];
      result_.estimate.joint_shift[j] += moved;
      farthest = std::max(farthest, std::abs(moved));
    }
    return farthest;
  }

  FrameDrawer& drawer_;
  const CalibrationEstimate& start_;
  const FitPriors& priors_;
  const FrameChoice choice_;
  Eigen::Index cameras_ = 0;
  Eigen::Index joints_ = 0;
  FitResult result_;
};

}  // namespace

void move_robot(const Eigen::Vector3d& rotation_C, const Eigen::Vector3d& move_C_m,
                const Eigen::Vector3d& pivot_C_m, CameraEstimate& camera) {
  const double angle = rotation_C.norm();
  const Eigen::AngleAxisd turn(angle,
                               angle > 0 ? (rotation_C / angle).eval() : Eigen::Vector3d::UnitX());
  const Pose moved =
      Eigen::Translation3d(pivot_C_m + move_C_m) * turn * Eigen::Translation3d(-pivot_C_m);
  camera.X_PC = camera.X_PC * moved.inverse();
}

FitResult fit(FrameDrawer& drawer, const CalibrationEstimate& start, const FitPriors& priors,
              const std::vector<FitRound>& rounds, FrameChoice choice) {
  return Fit(drawer, start, priors, choice).run(rounds);
}

CalibrationEstimate start_of(const CalibrationData& calibration_data) {
  CalibrationEstimate start;
  for (const CalibrationCamera* camera : calibration_data.cameras) {
    start.cameras.push_back({.X_PC = camera->X_PC});
  }
  start.joint_shift.assign(calibration_data.model->joints.size(), 0.0);
  return start;
}

}  // namespace berth
