// Two clocks: the camera's thread makes frames, the controller's asks, a thousand times a second, how far the
// robot would be where it is now or is about to go. Usage: two_clocks robot.urdf
#include <atomic>
#include <cstdio>
#include <memory>
#include <thread>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: two_clocks robot.urdf\n"), 2;
  const berth::RobotModel robot = berth::load_robot({.urdf = argv[1]});
  berth::CameraMount mount{{640, 480, 525, 525, 319.5, 239.5}, robot.links.front().name};
  mount.X_PC.linear() << 0, 0, -1, 1, 0, 0, 0, -1, 0;
  mount.X_PC.translation() << 2, 0, 0.5;
  const berth::Rig rig(robot, mount, {});
  const std::vector<double> home(robot.joints.size(), 0.0);

  std::atomic<std::shared_ptr<const berth::Frame>> latest;
  std::thread camera([&] {
    berth::Observer observer(rig);
    for (int i = 0; i < 10; ++i) {
      auto frame = std::make_shared<berth::Frame>();
      observer.observe(berth::DepthImage(640, 480, 2.6F), {i / 30.0, home}, *frame);
      latest = std::move(frame);
    }
  });
  while (!latest.load()) std::this_thread::yield();
  berth::Asker asker(rig);
  for (int i = 0; i < 5; ++i) {
    std::vector<double> next = home;
    for (double& position : next) position += 0.05 * i;
    const berth::Answer& answer = asker.ask(*latest.load(), {i / 1000.0, next});
    const berth::LinkDistance& last = answer.distances.links.back();
    std::printf("frame of %.3f s, last link: %.3f m\n", answer.frame_stamp_s, last.distance_m);
  }
  camera.join();
}
