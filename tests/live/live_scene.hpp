// The bundled scene, as if it ran now.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

#include "berth/live/joint_intake.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

inline std::vector<std::string> joint_names(const RobotModel& model) {
  std::vector<std::string> names;
  for (const MovableJoint& joint : model.joints) names.push_back(joint.name);
  return names;
}

/// All samples of the scene's joints up to a time, in the messages of one publisher.
inline void push_joints(const OpenScene& scene, double from_s, double to_s, JointIntake& joints) {
  const std::vector<std::string> names = joint_names(scene.robot->model());
  for (std::size_t i = 0; i < scene.joints->size(); ++i) {
    const JointState& sample = scene.joints->sample(i);
    if (sample.stamp_s > from_s && sample.stamp_s <= to_s) {
      joints.push(sample.stamp_s, names, sample.position);
    }
  }
}

/// Whether it came true within 20 s.
inline bool comes_true(const std::function<bool()>& what) {
  for (int i = 0; i < 20000; ++i) {
    if (what()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

}  // namespace berth
