// What a MountedCamera refuses, by name and value.
#include "berth/pipeline/mounted_camera.hpp"

#include <gtest/gtest.h>

#include "berth/robot/primitives.hpp"
#include "tests/support/error_message.hpp"

namespace berth {
namespace {

std::shared_ptr<const Robot> make_robot() {
  RobotModel model;
  model.name = "cube";
  Link link;
  link.name = "base";
  link.role = LinkRole::evaluated;
  link.id = 1;
  link.mesh_L = make_box({0.2, 0.2, 0.2});
  model.links.push_back(link);
  model.evaluated_links = {0};
  return std::make_shared<const Robot>(model);
}

std::string refusal(const Camera& camera, const Eigen::Matrix3d& rotation) {
  CameraMount mount{camera, "base", Pose::Identity()};
  mount.X_PC.linear() = rotation;
  return error_message<std::invalid_argument>([&] { MountedCamera(make_robot(), mount); });
}

constexpr Camera kCamera{64, 48, 50, 50, 31.5, 23.5};

TEST(MountedCamera, ARotationThatIsNoneIsRefused) {
  const Eigen::Matrix3d turned =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  EXPECT_EQ(refusal(kCamera, turned), "");
  Eigen::Matrix3d sheared = turned;
  sheared.col(0) += 0.1 * sheared.col(1);
  for (const Eigen::Matrix3d& wrong :
       {Eigen::Matrix3d(2 * turned), Eigen::Matrix3d(1000 * turned), Eigen::Matrix3d(-turned),
        Eigen::Matrix3d(0 * turned), sheared}) {
    const std::string message = refusal(kCamera, wrong);
    EXPECT_NE(message.find("the pose X_PC has no rotation"), std::string::npos) << message;
    EXPECT_NE(message.find("expected axes of length 1"), std::string::npos) << message;
  }
  // As a file with three decimals gives it.
  const Eigen::Matrix3d rounded = (turned * 1000).array().round() / 1000;
  EXPECT_EQ(refusal(kCamera, rounded), "");
}

TEST(MountedCamera, APoseThatNobodySetIsRefused) {
  EXPECT_EQ(error_message<std::invalid_argument>([] {
              MountedCamera(make_robot(), CameraMount{kCamera, "base"});
            }),
            "camera: the pose X_PC is not set; expected finite numbers");
}

TEST(MountedCamera, ACameraWithoutSizeOrFocusIsRefused) {
  const Eigen::Matrix3d straight = Eigen::Matrix3d::Identity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Camera& wrong :
       {Camera{}, Camera{0, 48, 50, 50, 31.5, 23.5}, Camera{64, 48, 0, 50, 31.5, 23.5},
        Camera{64, 48, 50, -50, 31.5, 23.5}, Camera{64, 48, 50, 50, nan, 23.5}}) {
    const std::string message = refusal(wrong, straight);
    EXPECT_NE(message.find("expected a size and focal lengths above 0"), std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace berth
