// Two clocks: the camera's thread makes frames of images and the joints at their exposure, the
// controller's asks, a thousand times a second, how far the robot is. Usage: two_clocks robot.urdf
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <mutex>
#include <thread>

#include "berth/pipeline/observer.hpp"
#include "berth/pipeline/query.hpp"

namespace {

/// The clock of all stamps.
double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void sleep_ms(int ms) { std::this_thread::sleep_for(std::chrono::milliseconds(ms)); }

/// The newest frame. It is swapped as a whole: who asks the one before keeps it alive until the
/// result is there. GCC 12's std::atomic<std::shared_ptr> has a race between reading and swapping.
class LatestFrame {
 public:
  void set(std::shared_ptr<const berth::Frame> frame) {
    const std::lock_guard lock(mutex_);
    frame_.swap(frame);
  }
  std::shared_ptr<const berth::Frame> get() const {
    const std::lock_guard lock(mutex_);
    return frame_;
  }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const berth::Frame> frame_;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: two_clocks robot.urdf\n"), 2;
  berth::EvaluationSettings evaluation;
  evaluation.time.max_frame_age_s = 1;  // this is no real-time system
  evaluation.time.max_joints_age_s = 0.1;
  const auto robot =
      std::make_shared<const berth::Robot>(berth::load_robot({.urdf = argv[1]}), evaluation);
  const berth::RobotModel& model = robot->model();
  berth::CameraMount mount{{640, 480, 525, 525, 319.5, 239.5}, model.links.front().name};
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  // A real camera has berth::settings_of_real_camera(): an image that does not show the robot is
  // not used then.
  const auto mounted = std::make_shared<const berth::MountedCamera>(robot, mount);
  berth::JointBuffer joints(model, 500);

  LatestFrame latest;
  std::atomic<bool> stop = false;
  std::thread encoders([&] {
    std::vector<std::string> names;
    for (const auto& joint : model.joints) names.push_back(joint.name);
    for (; !stop; sleep_ms(1)) joints.push(now_s(), names, std::vector<double>(names.size(), 0.0));
  });
  std::thread camera([&] {
    berth::Observer observer(mounted);
    while (!stop) {
      const double exposure_s = now_s();
      sleep_ms(33);  // the image is on its way
      auto frame = std::make_shared<berth::Frame>();
      observer.observe(berth::DepthImage(640, 480, 2.6F), exposure_s, joints, *frame);
      latest.set(std::move(frame));
    }
  });
  berth::Query query(robot);
  while (!latest.get()) sleep_ms(1);
  for (int i = 0; i < 100; ++i, sleep_ms(1)) {
    const std::shared_ptr<const berth::Frame> frame = latest.get();
    const berth::Result& result = query.ask({.frames = *frame, .joints = joints, .now_s = now_s()});
    if (result.status == berth::ResultStatus::stale) continue;  // a controller would slow down
    if (i % 20 == 0) {
      std::printf("image %.0f ms old, joints %.1f ms old, last link: %.3f m\n",
                  1e3 * result.time.frame_age_s, 1e3 * result.time.joints_age_s,
                  result.links.back().distance_m);
    }
  }
  stop = true;
  camera.join();
  encoders.join();
}
