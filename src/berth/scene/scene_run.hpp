#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "berth/pipeline/frame.hpp"
#include "berth/scene/backend.hpp"
#include "berth/scene/frame_result.hpp"
#include "berth/scene/gl_backend.hpp"
#include "berth/scene/open_scene.hpp"

namespace berth {

class FramePipeline;

/// The images of a scene, one after another, camera by camera, through the whole pipeline: what
/// the command, and whoever else runs scenes, stands on.
///
///     SceneRun run(scene);
///     while (run.next()) use(run.ask());
class SceneRun {
 public:
  /// The scene has to outlive it. Learns the background of the cameras that ask for one;
  /// `before_image` is called before each of these images. Throws std::runtime_error where the
  /// backend is not there or the scene's settings do not go with it.
  explicit SceneRun(const OpenScene& scene, const BackendChoice& where = {},
                    const std::function<void()>& before_image = [] {});
  ~SceneRun();
  SceneRun(const SceneRun&) = delete;
  SceneRun& operator=(const SceneRun&) = delete;

  /// Observes the next image; false where there is none.
  bool next();

  /// The rest is about that image. Its answer; valid until the next image.
  FrameResult ask();
  const OpenCamera& camera() const { return scene_.cameras[camera_]; }
  /// Its number among the images of its camera.
  std::size_t frame_number() const { return frame_; }
  DepthView sensor_depth_m() const { return depth_m_; }
  /// The images in this program's memory; read back from the GPU at each call.
  const Frame& frame();

 private:
  void learn_background(std::size_t camera, const std::function<void()>& before_image);

  const OpenScene& scene_;
  std::unique_ptr<GlBackend> gl_;
  /// One for each camera.
  std::vector<std::unique_ptr<FramePipeline>> pipelines_;
  bool has_begun_ = false;
  std::size_t camera_ = 0;
  std::size_t frame_ = 0;
  DepthImage depth_m_;
};

}  // namespace berth
