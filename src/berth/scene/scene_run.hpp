#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "berth/pipeline/asker.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/scene/backend.hpp"
#include "berth/scene/frame_result.hpp"
#include "berth/scene/gl_backend.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/plausibility.hpp"
#include "berth/scene/scene_steps.hpp"
#include "berth/separation/monitor.hpp"

namespace berth {

class FramePipeline;

/// The images of a scene, one after another, through the whole pipeline: what the command, and
/// whoever else runs scenes, stands on.
///
///     SceneRun run(scene);
///     while (run.next()) use(run.ask());
///
/// With method `mesh` the images of all cameras come in the order of their stamps, and each answer
/// is that of the newest image of every camera; with a method that compares images they come camera
/// by camera, and each answer is that of one image.
///
/// No image of a camera that is implausible (find_implausible) is used.
class SceneRun {
 public:
  /// The scene has to outlive it. Learns the background of the cameras that ask for one and whose
  /// scene does not name it;
  /// `before_image` is called before each of these images. Throws std::runtime_error where the
  /// backend is not there or the scene's settings do not go with it, and where all cameras are
  /// implausible; it says why.
  explicit SceneRun(
      const OpenScene& scene, const BackendChoice& where = {},
      const std::function<void()>& before_image = [] {});
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// Observes the next image, and all of other cameras that have its stamp; false where there is
  /// none.
  bool next();

  /// What was found of each camera before the first image.
  const std::vector<CameraPlausibility>& plausibility() const { return plausibility_; }

  /// The rest is about that image. The answer, asked so often, with the times of the questions
  /// where that is more than once; valid until the next image.
  FrameResult ask(int repeat = 0);
  const OpenCamera& camera() const { return scene_.cameras[step().camera]; }
  std::size_t camera_number() const { return step().camera; }
  /// Its number among the images of its camera.
  std::size_t frame_number() const { return step().frame; }
  DepthView sensor_depth_m() const { return newest_[step().camera].depth_m; }
  /// The images in this program's memory; read back from the GPU at each call. It stays as it is
  /// for who holds it.
  std::shared_ptr<const Frame> frame();

 private:
  /// One camera's newest image.
  struct Newest {
    std::optional<std::size_t> number;
    DepthImage depth_m;
  };

  const ImageStep& step() const { return steps_[step_ - 1]; }
  bool has_mesh() const;
  void make_monitors();
  void begin_background(std::size_t camera, const std::function<void()>& before_image);
  void observe(const ImageStep& step);
  void assign_frames();
  FrameResult result_of(const Answer& answer);
  CameraResult camera_result(std::size_t camera, const Answer& answer);
  const Separation& look(const Answer& answer, const FrameResult& result);

  const OpenScene& scene_;
  std::vector<CameraPlausibility> plausibility_;
  std::unique_ptr<GlBackend> gl_;
  /// One for each camera.
  std::vector<std::unique_ptr<FramePipeline>> pipelines_;
  std::vector<Newest> newest_;
  std::vector<ImageStep> steps_;
  /// How many of them were taken, and how many observed.
  std::size_t step_ = 0;
  std::size_t observed_ = 0;
  std::vector<std::shared_ptr<const Frame>> kept_;
  std::vector<const Frame*> frames_;
  FrameSet frame_set_;
  std::optional<Asker> asker_;
  /// Where the scene asks for them: one, or with methods that compare images one for each camera.
  std::vector<SeparationMonitor> monitors_;
  JointState joints_;
  std::vector<double> velocity_;
};

}  // namespace berth
