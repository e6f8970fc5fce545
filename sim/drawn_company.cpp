#include "sim/drawn_company.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "berth/robot/primitives.hpp"
#include "sim/drawn_person.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

using Eigen::Vector3d;

/// From one robot's base to the other's.
constexpr double kRobotsApart_m = 0.7;
/// From the base to the shoulder of somebody who guides the arm: how far and how high.
constexpr double kShoulderAway_m = 0.9, kShoulderHeight_m = 0.6;

Vector3d around(double angle_rad, double radius_m, double z_m = 0) {
  return {radius_m * std::cos(angle_rad), radius_m * std::sin(angle_rad), z_m};
}

double yaw_of(const Pose& X_BL) { return std::atan2(X_BL(1, 0), X_BL(0, 0)); }

/// A limb between two points.
DrawnObstacle limb(const Vector3d& from_B_m, const Vector3d& to_B_m, double radius_m) {
  const Vector3d way_m = to_B_m - from_B_m;
  Pose X_BO(turn_between(Vector3d::UnitZ(), way_m));
  X_BO.translation() = from_B_m + way_m / 2;
  return {make_cylinder(radius_m, way_m.norm()), X_BO};
}

/// What stays the same in all poses, and what each of them is made of.
class Company {
 public:
  Company(Random& random, const RobotModel& model,
          const std::vector<std::vector<double>>& positions)
      : random_(random), model_(model), last_(model.evaluated_links.back()) {
    for (const std::vector<double>& position : positions) poses_.push_back(pose_at(position));
    person_ = draw_person(random, Vector3d::Zero());
    side_rad_ = random(0, 2 * std::numbers::pi);
    base_rad_ = random(0, 2 * std::numbers::pi);
    away_m_ = random(0.25, 0.4);
  }

  std::vector<DrawnObstacle> in_pose(DrawnCompany company, std::size_t k) {
    switch (company) {
      case DrawnCompany::walker:
        return walker(k);
      case DrawnCompany::follower:
        return follower(k);
      case DrawnCompany::guide:
        return guide(k);
      case DrawnCompany::cart:
        return cart(k);
      case DrawnCompany::robot:
        return other_robot(pose_at(draw_joints(random_, model_).position));
      case DrawnCompany::twin:
        return other_robot(poses_[k]);
    }
    return {};
  }

 private:
  RobotPose pose_at(const std::vector<double>& position) const {
    RobotPose pose;
    forward_kinematics(model_, position, pose);
    return pose;
  }
  const Pose& tip(std::size_t k) const { return poses_[k].X_BL[last_]; }

  std::vector<DrawnObstacle> walker(std::size_t k) {
    const Vector3d beside_m = around(random_(0, 2 * std::numbers::pi), random_(0.22, 0.5), -0.25);
    return {{draw_person(random_, tip(k).translation() + beside_m), Pose::Identity()}};
  }

  std::vector<DrawnObstacle> follower(std::size_t k) {
    const double yaw_rad = yaw_of(tip(k));
    Pose X_BO(Eigen::AngleAxisd(yaw_rad, Vector3d::UnitZ()));
    X_BO.translation() = tip(k).translation() + around(side_rad_ + yaw_rad, away_m_, -0.25);
    return {{person_, X_BO}};
  }

  std::vector<DrawnObstacle> guide(std::size_t k) {
    const Vector3d middle_L_m = model_.links[last_].mesh_L.bounding_box_m().center().cast<double>();
    const Pose X_BO = tip(k) * Eigen::Translation3d(middle_L_m + around(side_rad_, 0.06));
    const Vector3d shoulder_m = around(base_rad_, kShoulderAway_m, kShoulderHeight_m) +
                                Vector3d(random_(-0.1, 0.1), random_(-0.1, 0.1), 0);
    const Vector3d elbow_m = (X_BO.translation() + shoulder_m) / 2 - Vector3d(0, 0, 0.1);
    return {{make_box({0.09, 0.1, 0.12}), X_BO},
            limb(X_BO.translation(), elbow_m, 0.04),
            limb(elbow_m, shoulder_m, 0.05),
            {person_, Pose(Eigen::Translation3d(shoulder_m - Vector3d(0, 0, 0.5)))}};
  }

  std::vector<DrawnObstacle> cart(std::size_t k) const {
    if (k == 0) return {};
    double lowest_m = std::numeric_limits<double>::infinity();
    for (const RobotPose& pose : poses_) {
      for (const Eigen::Vector3f& p_L_m : model_.links[last_].mesh_L.vertices_m) {
        lowest_m = std::min(lowest_m, (pose.X_BL[last_] * p_L_m.cast<double>()).z());
      }
    }
    return {{make_box({2, 2, 0.03}), Pose(Eigen::Translation3d(0, 0, lowest_m - 0.03))}};
  }

  std::vector<DrawnObstacle> other_robot(const RobotPose& pose) const {
    const Pose X_BA(Eigen::Translation3d(around(base_rad_, kRobotsApart_m)));
    std::vector<DrawnObstacle> links;
    for (const std::size_t i : model_.evaluated_links) {
      links.push_back({model_.links[i].mesh_L, X_BA * pose.X_BL[i]});
    }
    return links;
  }

  Random& random_;
  const RobotModel& model_;
  std::size_t last_;
  std::vector<RobotPose> poses_;
  TriangleMesh person_;
  double side_rad_ = 0;
  double base_rad_ = 0;
  double away_m_ = 0;
};

}  // namespace

void add_company(Random& random, const RobotModel& model, DrawnCompany company,
                 CarryingRobotSettings& settings) {
  Company drawn(random, model, settings.positions);
  settings.in_pose.resize(settings.positions.size());
  for (std::size_t k = 0; k < settings.positions.size(); ++k) {
    for (DrawnObstacle& thing : drawn.in_pose(company, k)) {
      settings.in_pose[k].push_back(std::move(thing));
    }
  }
}

}  // namespace berth::sim
