#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "berth/scene/open_scene.hpp"
#include "berth/scene/plausibility.hpp"
#include "thesis/gl_backend.hpp"
#include "thesis/image_result.hpp"

namespace berth {

/// The images of a scene, camera by camera, each asked alone:
///
///     ImageScene images(scene, Method::exact);
///     while (images.next()) use(images.ask());
class ImageScene {
 public:
  /// The scene has to outlive it. `before_image` is called before each image that a background is
  /// learned from. Throws as require_plausible does, std::runtime_error where the backend is not
  /// there or the scene's settings do not go with it, and std::invalid_argument for bad settings.
  ImageScene(
      const OpenScene& scene, Method method, const ImageSettings& settings = {},
      const BackendChoice& where = {}, const std::function<void()>& before_image = [] {});

  /// Reads and filters the next image; false where there is none.
  bool next();
  /// The result of that image, asked `repeat` times, with the times where that is above 0.
  ImageResult ask(int repeat = 0);

  /// What was found of each camera before the first image.
  const std::vector<CameraPlausibility>& plausibility() const { return plausibility_; }

 private:
  std::unique_ptr<ImageCamera> make_camera(const OpenCamera& camera, Method method,
                                           const ImageSettings& settings, Backend backend);

  const OpenScene& scene_;
  std::vector<CameraPlausibility> plausibility_;
  std::unique_ptr<GlBackend> gl_;
  std::vector<std::unique_ptr<ImageCamera>> cameras_;
  std::size_t camera_ = 0;
  /// Images of that camera that were taken.
  std::size_t taken_ = 0;
};

}  // namespace berth
