#pragma once

#include "berth/pipeline/observer.hpp"
#include "tests/record/recorded_scene.hpp"

namespace berth {

/// One camera that gives the same image ten times a second, and a monitor that is told to stop.
class OneCameraLoop : public RecordedScene {
 protected:
  OneCameraLoop()
      : observer_(scene_.cameras[0].mounted),
        query_(scene_.robot),
        monitor_(scene_.robot, lenient()),
        depth_m_(scene_.cameras[0].read_depth(0)) {
    scene_.separation = lenient();
  }

  /// Only velocities that nobody knows stop this robot.
  static SeparationSettings lenient() {
    SeparationSettings settings;
    settings.human_speed_m_s = settings.acceleration_m_s2 = settings.robot_uncertainty_m = 0;
    settings.intrusion_m = settings.camera_uncertainty_m = 0;
    settings.not_seen = settings.camera = settings.unknown = UnknownPolicy::ignore;
    settings.no_reading = UnknownPolicy::ignore;
    return settings;
  }

  void observe() {
    now_s_ += 0.1;
    frame_ = std::make_shared<Frame>();
    JointState joints = scene_.cameras[0].at_exposure[0];
    joints.stamp_s = now_s_;
    observer_.observe(depth_m_, joints, *frame_);
  }
  void ask(Recorder& recorder, bool stops) {
    const std::vector<std::shared_ptr<const Frame>> frames{frame_};
    const Result& result = recorder.ask(query_, {.frames = frames, .now_s = now_s_});
    // Joints that nobody knows have to stop.
    const std::vector<double> velocity(stops ? 0 : scene_.robot->model().joints.size(), 0.0);
    recorder.update(monitor_, result, velocity, now_s_);
  }
  void step(Recorder& recorder, bool stops = false) {
    observe();
    recorder.put(*frame_, depth_m_);
    ask(recorder, stops);
  }

  Observer observer_;
  Query query_;
  SeparationMonitor monitor_;
  DepthImage depth_m_;
  std::shared_ptr<Frame> frame_;
  double now_s_ = 100;
};

}  // namespace berth
