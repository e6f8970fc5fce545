// A scene and its frames, as pages see them.
#pragma once

#include "apps/view/page_message.hpp"
#include "berth/pipeline/frame.hpp"
#include "berth/pipeline/result.hpp"
#include "berth/scene/open_scene.hpp"
#include "berth/scene/scene_run.hpp"

namespace berth::app {

struct PageCamera {
  std::string name;
  Camera camera;
};

/// What stays as it is: links, cameras, steps, and the colours of pictures. `name` is that of the
/// scene's file; a running robot has no steps.
PageMessage scene_message(const std::string& name, const RobotModel& model,
                          const std::vector<PageCamera>& cameras,
                          const std::vector<ImageStep>& steps);
PageMessage scene_message(const OpenScene& scene, const std::vector<ImageStep>& steps);
std::vector<PageCamera> page_cameras(const OpenScene& scene);

/// The triangles of each link in its own frame: three floats for each corner, all links one after
/// another, then three whole numbers of 32 bits for each triangle, counted within the link.
PageMessage mesh_message(const RobotModel& model);

/// Which of a scene's steps a result is of.
struct ShownStep {
  std::size_t step = 0;
  /// Nothing is known yet of what needs all steps before: the result is that of its frames alone.
  bool is_provisional = false;
};

/// The frame on show: the result, and the poses of links and cameras in the root link's frame, each
/// as the four rows of its matrix. frames[c] is that of camera c, or null.
PageMessage shown_message(const RobotModel& model, const Result& result,
                          const std::vector<const Frame*>& frames, const ShownStep& of = {});

/// Pages get every n-th pixel of every n-th row, so that all cameras together have at most
/// kMostShownPixels. This is n.
int shown_stride(const std::vector<PageCamera>& cameras);
inline constexpr std::size_t kMostShownPixels = 1 << 22;

/// One camera's image: of each pixel that is shown the depth that counts (float, NaN: none), the
/// fate (8 bits), the link (16 bits) and how far its reading lies behind the robot's surface (16
/// bits, in mm; -32768: no reading or no robot).
PageMessage image_message(std::size_t camera, std::size_t number, const DepthImage& sensor_depth_m,
                          const Frame& frame, int stride);

}  // namespace berth::app
