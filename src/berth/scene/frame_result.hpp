#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "berth/types/camera.hpp"
#include "berth/types/link_distance.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/time_status.hpp"

namespace berth {

/// How long one frame's evaluation took, from three images in memory to the result.
struct EvaluateTiming {
  int repeat = 0;
  double min_us = 0;
  double p50_us = 0;
  double p99_us = 0;
  double max_us = 0;
};

/// All that is told of one frame.
struct FrameResult {
  int frame = 0;
  double stamp_s = 0;
  std::string camera;
  std::string method;
  /// The OpenGL renderer, where a part was computed on it.
  std::string gl_renderer;
  double range_m = 0;
  /// Whether to tell each link's lower bound: the search was allowed to end early.
  bool has_bounds = false;
  /// One for each of distances->links, in the same order.
  std::vector<std::string> link_names;
  /// Must be set; not owned.
  const LinkDistances* distances = nullptr;
  /// Where it is told, one for each of distances->links, in the same order; not owned.
  const std::vector<LinkVisibility>* visibility = nullptr;
  /// The pose of the camera in the robot's root link. With it, points are also told in the root's
  /// frame.
  std::optional<Pose> X_BC;
  /// How the frame's stamp and joints go together.
  std::optional<Timeliness> time;
  std::optional<EvaluateTiming> timing;
  /// Pixels of each PixelFate.
  std::optional<std::array<std::int64_t, kPixelFateCount>> self_filter;
};

}  // namespace berth
