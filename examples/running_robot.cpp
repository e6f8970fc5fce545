// A running robot: joint messages and images come from any thread, berth's own threads make them
// ready, and the controller asks, a thousand times a second. Usage: running_robot robot.urdf
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "berth/live/live_camera.hpp"
#include "berth/live/live_space.hpp"
#include "berth/pipeline/query.hpp"

namespace {

/// The clock of all stamps.
double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: running_robot robot.urdf\n"), 2;
  berth::EvaluationSettings evaluation;
  evaluation.time.max_frame_age_s = 1;  // this is no real-time system
  evaluation.time.max_joints_age_s = 0.1;
  const auto robot =
      std::make_shared<const berth::Robot>(berth::load_robot({.urdf = argv[1]}), evaluation);
  const berth::RobotModel& model = robot->model();
  berth::CameraMount mount{{640, 480, 525, 525, 319.5, 239.5}, model.links.front().name};
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  const auto mounted = std::make_shared<const berth::MountedCamera>(robot, mount);

  // In this order: each uses those before it until it is destroyed.
  berth::JointIntake joints(model, {});
  berth::LiveSpace space(robot, 1, joints);
  berth::LiveCamera camera(mounted, joints, {},
                           [&](const auto& frame, const auto&...) { space.put(0, frame); });
  std::atomic<bool> stop = false;
  std::thread encoders([&] {
    std::vector<std::string> names;
    for (const auto& joint : model.joints) names.push_back(joint.name);
    for (; !stop; sleep_ms(1)) {
      joints.push(now_s(), names, std::vector<double>(names.size(), 0.0));
      camera.look_again();
    }
  });
  std::thread driver([&] {
    while (!stop) {
      const double exposure_s = now_s();
      sleep_ms(33);  // the image is on its way
      berth::DepthImage image = camera.spare_image();
      image.resize(640, 480, 2.6F);
      camera.push(exposure_s, std::move(image));
    }
  });
  berth::Query query(robot);
  while (!space.newest()->frames()[0]) sleep_ms(1);
  for (int i = 0; i < 100; ++i, sleep_ms(1)) {
    const berth::Result& result =
        query.ask({.frames = space.newest(), .joints = joints.buffer(), .now_s = now_s()});
    if (result.status == berth::ResultStatus::stale) continue;  // a controller would slow down
    if (i % 20 == 0) {
      std::printf("image %.0f ms old, joints %.1f ms old, last link: %.3f m\n",
                  1e3 * result.time.frame_age_s, 1e3 * result.time.joints_age_s,
                  result.links.back().distance_m);
    }
  }
  stop = true;
  driver.join();
  encoders.join();
}
