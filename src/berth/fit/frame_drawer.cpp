#include "berth/fit/frame_drawer.hpp"
#include "berth/render/robot_renderer.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace berth {
namespace {

struct Drawing {
  RobotRenderer renderer;
  RobotImage image;
};
/// By step and camera.
using Drawings = std::map<std::pair<int, std::size_t>, Drawing>;

}  // namespace

struct FrameDrawer::Scratch {
  tbb::enumerable_thread_specific<Drawings> drawings;
};

FrameDrawer::FrameDrawer(const CalibrationData& calibration_data, const std::vector<int>& steps)
    : data_(calibration_data), scratch_(std::make_unique<Scratch>()) {
  for (const int step : steps) {
    if (levels_.count(step) > 0) continue;
    for (const CalibrationCamera* camera : calibration_data.cameras) {
      levels_[step].push_back(make_level(*camera, step));
    }
  }
}

FrameDrawer::~FrameDrawer() = default;

void FrameDrawer::draw(int step, const CalibrationEstimate& estimate,
                       const PosedRobotRequest& request, FrameChoice choice,
                       const std::function<void(const DrawnFrame&)>& take) {
  const std::vector<ImageLevel>& levels = levels_.at(step);
  std::vector<std::pair<std::size_t, std::size_t>> chosen;
  for (std::size_t c = 0; c < levels.size(); ++c) {
    for (std::size_t f = 0; f < levels[c].depth_m.size(); ++f) {
      if (is_chosen(choice, f)) chosen.emplace_back(c, f);
    }
  }
  const auto draw_one = [&](const std::pair<std::size_t, std::size_t>& which) {
    const auto [c, f] = which;
    const auto posed = pose_robot(data_, c, data_.cameras[c]->frames[f], estimate, request);
    if (!posed) return;
    Drawings& drawings = scratch_->drawings.local();
    auto found = drawings.find({step, c});
    if (found == drawings.end()) {
      Drawing fresh{RobotRenderer(data_.meshes, levels[c].camera), {}};
      found = drawings.emplace(std::pair(step, c), std::move(fresh)).first;
    }
    Drawing& drawing = found->second;
    drawing.renderer.render(posed->pose, posed->X_BC, drawing.image);
    take({c, f, step, levels[c].camera, levels[c].depth_m[f], *posed, drawing.image});
  };
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
    // Else a thread that waits inside could take a second frame, and draw it into the same image.
    tbb::this_task_arena::isolate([&] { draw_one(chosen[i]); });
  });
}

namespace {

/// The pixel that stands for the block of step x step pixels lies in its middle.
int middle_of(int step) { return step / 2; }

Camera thinned(const Camera& camera, int step) {
  const double middle = middle_of(step);
  return {camera.width_px / step, camera.height_px / step,        camera.fx_px / step,
          camera.fy_px / step,    (camera.cx_px - middle) / step, (camera.cy_px - middle) / step};
}

DepthImage thinned(const DepthImage& depth_m, int step) {
  DepthImage out(depth_m.width() / step, depth_m.height() / step);
  for (int v = 0; v < out.height(); ++v) {
    const float* from = depth_m.row(v * step + middle_of(step)) + middle_of(step);
    for (int u = 0; u < out.width(); ++u) out(u, v) = from[u * step];
  }
  return out;
}

}  // namespace

ImageLevel make_level(const CalibrationCamera& camera, int step) {
  ImageLevel level{step, thinned(camera.camera, step), {}};
  for (const CalibrationFrame& frame : camera.frames) {
    level.depth_m.push_back(thinned(frame.depth_m, step));
  }
  return level;
}

}  // namespace berth
