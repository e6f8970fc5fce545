#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "berth/separation/separation.hpp"
#include "berth/types/camera.hpp"
#include "berth/types/camera_status.hpp"
#include "berth/types/link_distance.hpp"
#include "berth/types/link_visibility.hpp"
#include "berth/types/obstacle_image.hpp"
#include "berth/types/time_status.hpp"

namespace berth {

/// How long a question took, so often: from images or frames in memory to the result.
struct AnswerTiming {
  int repeat = 0;
  double min_us = 0;
  double p50_us = 0;
  double p99_us = 0;
  double max_us = 0;
};

/// Of at least one time.
AnswerTiming timing_of(std::vector<double> times_us);

/// One camera's part in a result.
struct CameraResult {
  std::string name;
  /// The number of its newest image among its images; -1 where it has none yet.
  int frame = -1;
  CameraState state;
  /// The pose of the optical frame in the robot's root link, where the frame has one.
  std::optional<Pose> X_BC;
  /// Pixels of each PixelFate.
  std::optional<std::array<std::int64_t, kPixelFateCount>> self_filter;
};

/// All that is told of one frame, or of one line of a scene with several cameras.
struct FrameResult {
  int frame = 0;
  double stamp_s = 0;
  /// One, unless the method is mesh. LinkDistance::view is a place in it. Empty for three images
  /// without a scene.
  std::vector<CameraResult> cameras;
  std::string method;
  /// Whether the method compares images, and so tells pixels of the robot.
  bool asks_images = true;
  /// The OpenGL renderer, where a part was computed on it.
  std::string gl_renderer;
  double range_m = 0;
  /// Whether to tell each link's lower bound: the search was allowed to end early.
  bool has_bounds = false;
  /// One for each of distances->links, in the same order, here and below.
  std::vector<std::string> link_names;
  /// Whether a joint moves the link; those that stand where they stand come last in tables and
  /// pictures. Empty: all are moved.
  std::vector<bool> link_is_moved;
  /// Must be set; not owned.
  const LinkDistances* distances = nullptr;
  /// Where it is told; not owned.
  const std::vector<LinkVisibility>* visibility = nullptr;
  /// Where it is monitored; not owned.
  const Separation* separation = nullptr;
  /// How the frame's stamp and joints go together.
  std::optional<Timeliness> time;
  /// In JSON under this name: evaluate_us or ask_us.
  std::string timing_name = "evaluate_us";
  std::optional<AnswerTiming> timing;

  bool is_moved(std::size_t link) const { return link_is_moved.empty() || link_is_moved[link]; }
  /// With one camera its pose; with it, points are told in both frames.
  std::optional<Pose> X_BC() const {
    return cameras.size() == 1 ? cameras.front().X_BC : std::nullopt;
  }
};

}  // namespace berth
