// Any image of a scene with its answer, in any order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/observer.hpp"
#include "berth/scene/frame_result.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/scene_steps.hpp"

namespace berth::app {

/// What SceneRun gives for one step of a scene, without the steps before it: what needs all images
/// (whether a camera has moved or is implausible, the background) is left to SceneRun, so that the
/// wrong pose of a camera can be seen.
class SceneFrames {
 public:
  /// Throws std::runtime_error where the scene's method runs on OpenGL.
  explicit SceneFrames(std::shared_ptr<const OpenScene> scene);

  const OpenScene& scene() const { return *scene_; }
  const std::vector<ImageStep>& steps() const { return steps_; }

  /// Observes what is known at this step.
  void show(std::size_t step);

  // The rest is about that step.

  /// Asks. Valid until the next call of either.
  FrameResult ask();
  std::size_t step() const { return step_; }
  /// Null where a camera has no image yet, as with methods that compare images the other cameras.
  const Frame* frame(std::size_t camera) const { return frames_[camera]; }
  /// The number of that image.
  std::size_t frame_number(std::size_t camera) const { return *cameras_[camera].number; }
  const DepthImage& sensor_depth_m(std::size_t camera) const { return cameras_[camera].depth_m; }
  /// For method `mesh`: what the cameras leave.
  const FrameSet& frame_set() const { return frame_set_; }

 private:
  struct CameraFrames {
    std::unique_ptr<Observer> observer;
    std::optional<std::size_t> number;
    DepthImage depth_m;
    Frame frame;
  };
  bool has_mesh() const { return scene_->robot->settings().method == Method::mesh; }
  void observe(std::size_t camera, std::size_t frame);
  CameraResult camera_result(std::size_t camera, const Answer& answer) const;

  std::shared_ptr<const OpenScene> scene_;
  std::vector<ImageStep> steps_;
  std::vector<CameraFrames> cameras_;
  std::vector<const Frame*> frames_;
  FrameSet frame_set_;
  Asker asker_;
  std::size_t step_ = 0;
};

}  // namespace berth::app
