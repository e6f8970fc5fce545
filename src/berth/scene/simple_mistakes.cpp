#include "berth/scene/simple_mistakes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "berth/robot/kinematics.hpp"
#include "berth/types/pose.hpp"

namespace berth {
namespace {

constexpr double kDegree_rad = std::numbers::pi / 180;
/// Focal lengths from half to twice are tried in steps with which one that lies between two of them
/// is 3 % off.
constexpr double kLeastFocalFactor = 1.12;
constexpr double kGreatestFocalFactor = 2.01;
constexpr double kFocalStep = 1.06;
/// With 80 %, one of 30 poses that are 2 cm and 2 degrees off was taken for a focal length.
constexpr double kLeastWithFocalLength = 0.9;

/// The mistakes of one camera, one after another.
class Mistakes {
 public:
  Mistakes(const OpenScene& scene, const RobotInImages& images)
      : scene_(scene), images_(images), camera_(images.camera()), given_(images.given()) {}

  std::vector<SimpleMistake> optical() {
    add_optical();
    return std::move(found_);
  }
  std::vector<SimpleMistake> all() {
    const std::string in_scene =
        "camera " + camera_.source.name +
        (scene_.file.empty() ? std::string() : " in " + scene_.file.string());
    add_depths();
    place_new(in_scene);
    add_optical();
    add_positions();
    add_rotations();
    add_turned_bases();
    place_new(in_scene);
    add_swapped_bytes();
    add_images();
    place_new(fmt::format("the images of camera {}", camera_.source.name));
    const std::size_t of_camera = found_.size();
    add_joint_units();
    add_joint_orders();
    add_single_joints();
    place_new(scene_.joints ? scene_.joints->source() : "the joints");
    for (std::size_t i = of_camera; i < found_.size(); ++i) found_[i].is_of_joints = true;
    return std::move(found_);
  }

 private:
  /// Of those that have no place yet.
  void place_new(const std::string& place) {
    for (SimpleMistake& mistake : found_) {
      if (mistake.place.empty()) mistake.place = place;
    }
  }

  template <class Change>
  void add(std::string cause, const Change& change) {
    CameraBelief corrected = given_;
    change(corrected);
    found_.push_back({.cause = std::move(cause), .corrected = std::move(corrected)});
  }
  void add_pose(std::string cause, const Pose& X_PC) {
    add(std::move(cause), [&](CameraBelief& belief) { belief.mount.X_PC = X_PC; });
  }

  void add_depths() {
    for (const double factor : {4.0, 5.0, 8.0, 10.0, 100.0, 1000.0}) {
      add_depth(factor);
      add_depth(1 / factor);
    }
  }
  void add_swapped_bytes() {
    add("the two bytes of each pixel are swapped",
        [](CameraBelief& belief) { belief.is_swapped = true; });
  }
  void add_depth(double factor) {
    add(fmt::format("depth_scale is {:.6g}, not {:.6g}", factor * camera_.source.depth_scale_m,
                    camera_.source.depth_scale_m),
        [&](CameraBelief& belief) { belief.depth_factor = factor; });
  }

  void add_optical() {
    found_.push_back(depth_along_ray(images_));
    const Camera& camera = given_.mount.camera;
    for (double f = kLeastFocalFactor; f <= kGreatestFocalFactor; f *= kFocalStep) {
      for (const double factor : {f, 1 / f}) {
        const std::string fx =
            fmt::format("fx is about {:.0f} px, not {:.6g}", factor * camera.fx_px, camera.fx_px);
        const std::string fy =
            fmt::format("fy is about {:.0f} px, not {:.6g}", factor * camera.fy_px, camera.fy_px);
        add_focal_length(fmt::format("the focal length is about {:.0f} px, not {:.6g}",
                                     factor * camera.fx_px, camera.fx_px),
                         factor, factor);
        add_focal_length(fx, factor, 1);
        add_focal_length(fy, 1, factor);
      }
    }
    add("cx and cy are swapped", [](CameraBelief& belief) {
      std::swap(belief.mount.camera.cx_px, belief.mount.camera.cy_px);
    });
    found_.back().place = camera_.source.info.string();
  }
  void add_focal_length(const std::string& cause, double x, double y) {
    add(cause, [&](CameraBelief& belief) {
      belief.mount.camera.fx_px *= x;
      belief.mount.camera.fy_px *= y;
    });
    found_.back().place = camera_.source.info.string();
    found_.back().least_share = kLeastWithFocalLength;
  }

  Pose with_place(const Eigen::Vector3d& xyz_m) const {
    Pose X_PC = given_.mount.X_PC;
    X_PC.translation() = xyz_m;
    return X_PC;
  }
  Pose with_rotation(const Eigen::Quaterniond& rotation) const {
    return Eigen::Translation3d(given_.mount.X_PC.translation()) * rotation.normalized();
  }

  void add_positions() {
    const Eigen::Vector3d xyz_m = given_.mount.X_PC.translation();
    add_pose("the pose's xyz is in millimetres", with_place(xyz_m / 1000));
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector3d other_m = xyz_m;
      other_m[axis] = -other_m[axis];
      add_pose(fmt::format("the pose's {} has the wrong sign", "xyz"[axis]), with_place(other_m));
    }
    add_pose("the pose's x and y are swapped", with_place({xyz_m.y(), xyz_m.x(), xyz_m.z()}));
    add_pose("the pose's y and z are swapped", with_place({xyz_m.x(), xyz_m.z(), xyz_m.y()}));
  }

  void add_rotations() {
    const Pose& X_PC = given_.mount.X_PC;
    const Eigen::Quaterniond q(X_PC.linear());
    if (camera_.source.rpy_rad) {
      add_pose("the pose's rpy is in degrees",
               with_rotation(rotation_of_rpy(kDegree_rad * *camera_.source.rpy_rad)));
    }
    add_pose("the pose is that of the robot in the camera's frame", X_PC.inverse());
    add_pose("the pose's rotation is inverted", with_rotation(q.conjugate()));
    add_pose("the quaternion's order is w, x, y, z",
             with_rotation(Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w())));
    // Axes of the optical frame in one with x forward, y left, z up.
    const Eigen::Quaterniond X_body_optical(
        (Eigen::Matrix3d() << 0, 0, 1, -1, 0, 0, 0, -1, 0).finished());
    add_pose("the pose is that of a frame with x forward, not of the optical frame (z forward)",
             with_rotation(q * X_body_optical));
    add_pose("the pose is turned from x forward to the optical frame twice",
             with_rotation(q * X_body_optical.conjugate()));
    add_pose("the image is turned by 180 degrees against the pose",
             with_rotation(q * Eigen::Quaterniond(0, 0, 0, 1)));
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
      mirror(axis, axis) = -1;
      const Eigen::Matrix3d turn = mirror * X_PC.linear() * mirror;
      Pose mirrored = with_rotation(Eigen::Quaterniond(turn));
      mirrored.translation() = mirror * X_PC.translation();
      add_pose(fmt::format("the pose is mirrored in {}", "xy"[axis]), mirrored);
    }
  }

  /// About the root's z axis; of a camera that no joint moves.
  void add_turned_bases() {
    const RobotModel& model = scene_.robot->model();
    const std::size_t parent = model.find_link(given_.mount.parent_link).value();
    if (model.is_moved(parent) || given_.positions.empty()) return;
    RobotPose pose;
    forward_kinematics(model, given_.positions.front(), pose);
    const Pose& X_BP = pose.X_BL[parent];
    for (const int degrees : {180, 90, -90}) {
      const Pose turn(Eigen::AngleAxisd(degrees * kDegree_rad, Eigen::Vector3d::UnitZ()));
      add_pose(fmt::format("the pose is in a base that is turned by {} degrees about z", degrees),
               X_BP.inverse() * turn * X_BP * given_.mount.X_PC);
    }
  }

  void add_images() {
    add("the images are mirrored from left to right",
        [](CameraBelief& belief) { belief.is_mirrored = true; });
    for (std::size_t c = 0; c < scene_.cameras.size(); ++c) {
      if (c == given_.images_of) continue;
      add(fmt::format("the images are those of camera {}", name_of(c)),
          [&](CameraBelief& belief) { belief.images_of = c; });
      if (scene_.cameras[c].mounted->mount().parent_link != given_.mount.parent_link) continue;
      add_pose(fmt::format("the pose is that of camera {}", name_of(c)),
               scene_.cameras[c].mounted->mount().X_PC);
    }
    add_frame_shift(1, "the joints are those of one image later");
    add_frame_shift(-1, "the joints are those of one image earlier");
  }
  std::string name_of(std::size_t camera) const { return scene_.cameras[camera].source.name; }

  void add_frame_shift(int shift, const char* cause) {
    const auto last = static_cast<int>(camera_.at_exposure.size()) - 1;
    if (last < 1) return;
    add(cause, [&](CameraBelief& belief) {
      for (std::size_t i = 0; i < belief.positions.size(); ++i) {
        const int k = std::clamp(static_cast<int>(images_.frames()[i]) + shift, 0, last);
        if (camera_.exposure_time[k].status != TimeStatus::ok) continue;
        belief.positions[i] = camera_.at_exposure[k].position;
      }
    });
  }

  void add_joint_units() {
    const auto scaled = [&](double factor) {
      return [this, factor](CameraBelief& belief) {
        const auto& joints = scene_.robot->model().joints;
        for (std::vector<double>& position : belief.positions) {
          for (std::size_t j = 0; j < joints.size(); ++j) {
            if (joints[j].type != JointType::prismatic) position[j] *= factor;
          }
        }
      };
    };
    add("the joints are in degrees", scaled(kDegree_rad));
    add("the joints are turned from degrees to radians twice", scaled(1 / kDegree_rad));
  }

  void add_joint_orders() {
    const auto& joints = scene_.robot->model().joints;
    for (std::size_t j = 0; j + 1 < joints.size(); ++j) {
      add(fmt::format("joints {} and {} are swapped", joints[j].name, joints[j + 1].name),
          [&](CameraBelief& belief) {
            for (std::vector<double>& position : belief.positions) {
              std::swap(position[j], position[j + 1]);
            }
          });
    }
    add("the joints' order is reversed", [](CameraBelief& belief) {
      for (std::vector<double>& position : belief.positions) std::ranges::reverse(position);
    });
  }

  void add_single_joints() {
    const auto& joints = scene_.robot->model().joints;
    for (std::size_t j = 0; j < joints.size(); ++j) {
      const auto add_one = [&](const char* what, double factor, double more) {
        add(fmt::format("joint {} {}", joints[j].name, what), [&](CameraBelief& belief) {
          for (auto& position : belief.positions) position[j] = factor * position[j] + more;
        });
      };
      add_one("has the wrong sign", -1, 0);
      if (joints[j].type == JointType::prismatic) {
        add_one("is in millimetres", 0.001, 0);
        continue;
      }
      // Of a single joint that is said already.
      if (joints.size() > 1) add_one("is in degrees", kDegree_rad, 0);
      add_one("has its zero 180 degrees away", 1, std::numbers::pi);
      add_one("has its zero 90 degrees away", 1, std::numbers::pi / 2);
      add_one("has its zero -90 degrees away", 1, -std::numbers::pi / 2);
    }
  }

  const OpenScene& scene_;
  const RobotInImages& images_;
  const OpenCamera& camera_;
  const CameraBelief& given_;
  std::vector<SimpleMistake> found_;
};

}  // namespace

std::vector<SimpleMistake> simple_mistakes(const OpenScene& scene, const RobotInImages& images) {
  return Mistakes(scene, images).all();
}

SimpleMistake depth_along_ray(const RobotInImages& images) {
  SimpleMistake mistake{
      .cause =
          "the images hold distances along the ray, not along the camera's axis (depth_is: ray)",
      .place = fmt::format("camera {} in the scene", images.camera().source.name),
      .corrected = images.given()};
  mistake.corrected.is_along_ray = true;
  return mistake;
}

std::vector<SimpleMistake> optical_mistakes(const OpenScene& scene, const RobotInImages& images) {
  return Mistakes(scene, images).optical();
}

}  // namespace berth
