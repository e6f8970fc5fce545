// Simple mistakes, made in a scene that is right.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "berth/scene/open_scene.hpp"

namespace berth::lab {

/// One mistake in what a scene says of one of its cameras.
struct MadeMistake {
  std::string name;
  /// What has to stand in the explanation; empty where nothing simple explains it.
  std::string cause;
  std::function<void(OpenScene&, std::size_t camera)> make;
  /// It may leave the robot where it is, as the last joint's sign does with a round flange.
  bool is_slight = false;
};

/// All that are made in a scene.
std::vector<MadeMistake> mistakes_in(const OpenScene& scene);

/// The camera believed to be elsewhere.
void set_mount(const OpenScene& scene, OpenCamera& camera, const CameraMount& mount);

}  // namespace berth::lab
