// The node's monitor beside the library's, on the bundled scene.
#include "speed_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "berth/pipeline/observer.hpp"
#include "berth/record/monitor_loop.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth_ros {
namespace {

/// A robot that is hardly ever in somebody's way.
berth::SeparationSettings lenient() {
  berth::SeparationSettings settings;
  settings.human_speed_m_s = 0.2;
  settings.intrusion_m = settings.least_seen = settings.acceleration_m_s2 = 0;
  settings.camera_uncertainty_m = settings.robot_uncertainty_m = 0;
  settings.deceleration_m_s2 = 0.4;
  settings.not_seen = settings.unknown = berth::UnknownPolicy::ignore;
  settings.no_reading = berth::UnknownPolicy::ignore;
  return settings;
}

sensor_msgs::msg::JointState message_of(const berth::RobotModel& model,
                                        const std::vector<double>& velocity) {
  sensor_msgs::msg::JointState message;
  for (const berth::MovableJoint& joint : model.joints) message.name.push_back(joint.name);
  message.velocity = velocity;
  return message;
}

TEST(SpeedMonitor, LooksAlongTheRobotsWayAsTheLibraryDoes) {
  const berth::OpenScene scene = berth::open_scene(BUNDLED_SCENE);
  const berth::OpenCamera& camera = scene.cameras.front();
  berth::Observer observer(camera.mounted);
  berth::MonitorLoop loop(scene.robot, {}, lenient());
  berth::SeparationMonitor twin(scene.robot, lenient());
  PlannedVelocity planned;
  int along_the_way = 0;
  for (std::size_t k = 0; k < camera.at_exposure.size(); k += 3) {
    const auto frame = std::make_shared<berth::Frame>();
    observer.observe(camera.read_depth(k), camera.at_exposure[k], *frame);
    const double now_s = frame->stamp_s + 0.01;
    const std::vector<std::shared_ptr<const berth::Frame>> frames = {frame};
    loop.ask({.frames = frames, .joints = camera.at_exposure[k], .now_s = now_s});
    std::vector<double> velocity;
    scene.joints->velocity(frame->stamp_s, velocity);
    planned.take(message_of(scene.robot->model(), velocity), scene.robot->model(), now_s);
    berth_msgs::msg::Separation out;
    const berth::Result& result = loop.monitor(planned.at(now_s, 1), now_s);
    to_message(result, planned.is_there(), out);
    const berth::Separation& expected = twin.update(result, velocity, now_s, &loop.frames());
    EXPECT_EQ(out.basis, name_of(expected.basis)) << k;
    EXPECT_EQ(out.speed_scale, expected.speed_scale) << k;
    along_the_way += out.basis == "path";
  }
  EXPECT_GT(along_the_way, 0);
}

}  // namespace
}  // namespace berth_ros
