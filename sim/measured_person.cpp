#include "sim/measured_person.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "berth/files/error.hpp"
#include "sim/bundled_camera.hpp"
#include "sim/motion.hpp"
#include "sim/person.hpp"
#include "sim/random.hpp"
#include "sim/room.hpp"
#include "sim/shapes.hpp"
#include "sim/turn_between.hpp"

namespace berth::sim {
namespace {

using Eigen::Vector3d;

constexpr double kWork_s = 3, kComes_m = 2.0;
constexpr double kHandMiddle_m = 0.09, kToe_m = 0.03;

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

struct Thickness {
  std::string_view part;
  double radius_m;
};

/// Of a bone, by the joint at its end, as files of CMU name them. The first name counts that is a
/// part of the joint's.
double radius_m(const std::string& joint) {
  constexpr std::array<Thickness, 15> kThickness{{{"forearm", 0.048},
                                                  {"hand", 0.040},
                                                  {"shldr", 0.065},
                                                  {"collar", 0.09},
                                                  {"shoulder", 0.09},
                                                  {"head", 0.055},
                                                  {"neck", 0.12},
                                                  {"thigh", 0.11},
                                                  {"upleg", 0.11},
                                                  {"buttock", 0.11},
                                                  {"shin", 0.075},
                                                  {"leg", 0.075},
                                                  {"foot", 0.055},
                                                  {"toe", kToe_m},
                                                  {"arm", 0.065}}};
  constexpr double kTrunk_m = 0.13;
  const std::string name = lower(joint);
  for (const auto& [part, radius_m] : kThickness) {
    if (name.find(part) != std::string::npos) return radius_m;
  }
  return kTrunk_m;
}

bool is_foot(const std::string& joint) {
  const std::string name = lower(joint);
  return name.find("foot") != std::string::npos || name.find("toe") != std::string::npos;
}

/// Where the shape's z lies along a direction.
Pose along(const Vector3d& direction) { return Pose(turn_between(Vector3d::UnitZ(), direction)); }

/// Whether a camera as low as people are stands in the way of who comes from there.
bool runs_into_camera(double direction_rad) {
  constexpr double kTop_m = 1.2, kBeside_m = 0.5;
  const Vector3d side(-std::sin(direction_rad), std::cos(direction_rad), 0);
  return std::ranges::any_of(bundled_cameras(), [&](const BundledCamera& camera) {
    const Vector3d& p_T_m = camera.place.xyz_T_m;
    const double beside_m = std::abs(p_T_m.dot(side));
    const bool is_ahead = p_T_m.dot(side.cross(Vector3d::UnitZ())) > 0;
    return p_T_m.z() < kTop_m && is_ahead && beside_m < kBeside_m;
  });
}

/// In the frame of a joint at rest: y up, z to the front.
TriangleMesh make_head() {
  TriangleMesh head;
  append(head, make_ellipsoid({0.077, 0.12, 0.098}, 24), translation(0, 0.09, 0.02));
  return head;
}

}  // namespace

std::vector<std::size_t> hand_joints(const Bvh& motion) {
  std::vector<std::size_t> hands;
  for (std::size_t j = 1; j < motion.joints.size(); ++j) {
    if (lower(motion.joints[j].name).ends_with("hand")) hands.push_back(j);
  }
  if (hands.size() != 2) {
    throw_bad_file({motion.file, 0, "HIERARCHY"},
                   fmt::format("{} joints with a name on \"hand\"", hands.size()),
                   "two, such as rHand and lHand");
  }
  return hands;
}

Vector3d hand_middle_m(const Bvh& motion, std::size_t hand_joint) {
  return kHandMiddle_m * motion.joints[hand_joint].offset_m.normalized();
}

MeasuredPerson::MeasuredPerson(std::span<const Bvh> motions, std::uint32_t seed) {
  Random random(seed);
  motion_ =
      &motions[static_cast<std::size_t>(random.whole(0, static_cast<int>(motions.size()) - 1))];
  factor_ = random(0.9, 1.1);
  first_s_ = random(0, 1) * std::max(0.0, motion_->duration_s() - kWork_s);
  speed_m_s_ = random(1.0, 1.6);
  make_body();
  double direction_rad = 0;
  do {
    direction_rad = random(-std::numbers::pi, std::numbers::pi);
  } while (runs_into_camera(direction_rad));
  const double range_m = random(0.6, 1.1);
  place(direction_rad, range_m, random(-0.6, 0.6));
}

void MeasuredPerson::make_body() {
  const std::vector<std::size_t> hands = hand_joints(*motion_);
  for (std::size_t j = 0; j < motion_->joints.size(); ++j) {
    const BvhJoint& joint = motion_->joints[j];
    TriangleMesh mesh;
    if (std::ranges::find(hands, j) != hands.end()) {
      append(mesh, make_hand(), along(joint.offset_m));
    } else if (lower(joint.name).ends_with("head")) {
      append(mesh, make_head());
    } else {
      for (const BvhJoint& child : motion_->joints) {
        const bool is_bone = child.parent == static_cast<int>(j) && child.offset_m.norm() > 0 &&
                             (!child.name.empty() || is_foot(joint.name));
        if (!is_bone) continue;
        const double r_m = child.name.empty() ? kToe_m : radius_m(child.name);
        append(mesh, make_capsule(child.offset_m.norm(), r_m, r_m, 20), along(child.offset_m));
      }
    }
    if (mesh.empty()) continue;
    for (Eigen::Vector3f& p : mesh.vertices_m) p *= static_cast<float>(factor_);
    meshes_.push_back(std::move(mesh));
    joints_.push_back(j);
  }
}

void MeasuredPerson::place(double direction_rad, double range_m, double turn_rad) {
  constexpr double kBetween_s = 0.1;
  const std::vector<std::size_t> hands = hand_joints(*motion_);
  Vector3d hands_m = Vector3d::Zero(), hips_m = Vector3d::Zero();
  double lowest_m = std::numeric_limits<double>::infinity();
  std::vector<Vector3d> points_m;
  int count = 0;
  for (double t = 0; t <= kWork_s; t += kBetween_s, ++count) {
    const std::vector<Pose> X_WM = working(t);
    for (std::size_t i = 0; i < meshes_.size(); ++i) {
      if (std::ranges::find(hands, joints_[i]) != hands.end()) {
        hands_m += X_WM[i].translation() / 2;
      }
      for (const Eigen::Vector3f& p : meshes_[i].vertices_m) {
        points_m.push_back(X_WM[i] * p.cast<double>());
        lowest_m = std::min(lowest_m, points_m.back().z());
      }
    }
    // The first mesh is the root's.
    hips_m += X_WM.front().translation();
  }
  hands_m /= count;
  hips_m /= count;
  outwards_ = rotation(direction_rad, Vector3d::UnitZ()) * Vector3d::UnitX();
  const Vector3d front_m = hands_m - hips_m;
  const double front_rad = std::atan2(front_m.y(), front_m.x());
  const Vector3d hands_at_m = range_m * outwards_;
  X_BW_ = translation(hands_at_m.x(), hands_at_m.y(), kFloorZ_m - lowest_m) *
          rotation(direction_rad + std::numbers::pi + turn_rad - front_rad, Vector3d::UnitZ()) *
          translation(-hands_m.x(), -hands_m.y(), 0);
  constexpr double kFree_m = 0.03, kStep_m = 0.02;
  const Box& top = table_boxes().front();
  const Vector3d half_m = top.size_m / 2 + Vector3d::Constant(kFree_m);
  std::erase_if(points_m, [&](Vector3d& p) {
    p = X_BW_ * p;
    return p.z() > top.centre_T_m.z() + half_m.z();
  });
  const auto is_in_table = [&](const Vector3d& p) {
    const Vector3d from_middle_m = (p - top.centre_T_m).cwiseAbs();
    return from_middle_m.x() < half_m.x() && from_middle_m.y() < half_m.y();
  };
  while (std::ranges::any_of(points_m, is_in_table)) {
    for (Vector3d& p : points_m) p += kStep_m * outwards_;
    X_BW_ = Eigen::Translation3d(kStep_m * outwards_) * X_BW_;
  }
}

std::vector<Pose> MeasuredPerson::working(double time_s) const {
  const double most_s = motion_->duration_s() - first_s_;
  const double folded_s = std::fmod(time_s, 2 * most_s);
  const double within_s = first_s_ + std::min(folded_s, 2 * most_s - folded_s);
  const std::vector<Pose> X_WJ = joint_poses(*motion_, within_s);
  std::vector<Pose> X_BM;
  for (const std::size_t joint : joints_) {
    Pose X_WM = X_WJ[joint];
    X_WM.translation() *= factor_;
    X_BM.push_back(X_BW_ * X_WM);
  }
  return X_BM;
}

double MeasuredPerson::walk_s() const {
  // The greatest slope of smooth_step.
  return 1.875 * kComes_m / speed_m_s_;
}

double MeasuredPerson::duration_s() const { return 2 * walk_s() + kWork_s; }

std::vector<Pose> MeasuredPerson::pose_at(double time_s) const {
  std::vector<Pose> X_BM = working(std::clamp(time_s - walk_s(), 0.0, kWork_s));
  const double away = 1 - smooth_step(0, walk_s(), time_s) +
                      smooth_step(duration_s() - walk_s(), duration_s(), time_s);
  const double beyond_s = std::max({0.0, -time_s, time_s - duration_s()});
  const Eigen::Translation3d moved((kComes_m * away + speed_m_s_ * beyond_s) * outwards_);
  for (Pose& X : X_BM) X = moved * X;
  return X_BM;
}

}  // namespace berth::sim
