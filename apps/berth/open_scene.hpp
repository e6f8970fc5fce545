#pragma once

#include <memory>
#include <string>
#include <vector>

#include "apps/berth/arguments.hpp"
#include "berth/io/scene.hpp"
#include "berth/pipeline/rig.hpp"
#include "berth/types/joint_state.hpp"

namespace berth {

/// A camera of a scene, ready to be run.
struct OpenCamera {
  SceneCamera source;
  std::unique_ptr<const Rig> rig;
  /// The joint angles when each image was exposed.
  std::vector<JointState> at_exposure;
  /// And how they were found: all NaN where this is not ok.
  std::vector<FrameTime> exposure_time;

  DepthImage read_depth(std::size_t frame) const;
};

struct OpenScene {
  std::filesystem::path file;
  std::vector<OpenCamera> cameras;
  std::size_t frame_count = 0;  ///< of all cameras

  /// That of all cameras.
  Method method() const { return cameras.front().rig->settings().method; }
};

/// Reads a scene and all that it names, each depth image included, so that nothing that can be
/// known to be bad is found only after results were given. The arguments win over the scene file.
/// A frame whose stamp the joints do not reach is no error but has that status, unless all of a
/// camera's frames are so.
/// Throws std::runtime_error with file, place, value and what was expected, and Interrupted.
OpenScene open_scene(const std::filesystem::path& file, const EvaluationArguments& arguments);

}  // namespace berth
