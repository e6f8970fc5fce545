#include "apps/view/live_page.hpp"

#include <fmt/format.h>
#include "berth/pipeline/frame_space.hpp"

#include <chrono>
#include <stdexcept>

#include "apps/view/curves.hpp"

namespace berth::app {
namespace {

/// Half a minute at 30 Hz; docs/view.md describes it.
constexpr std::size_t kMostLiveColumns = 900;
constexpr std::chrono::milliseconds kBetweenCurves{250};

/// The camera's own image, to half a millimetre, where the frame has kept it.
DepthImage sensor_depth_of(const Frame& frame) {
  if (!frame.space->seen.has_free_depth) return frame.obstacles.depth_m;
  const UnitImage& kept = frame.space->seen.sensor_depth;
  DepthImage depth_m(kept.width(), kept.height(), kNoDepth);
  for (int v = 0; v < kept.height(); ++v) {
    for (int u = 0; u < kept.width(); ++u) {
      if (kept(u, v) != kEndlessUnits) depth_m(u, v) = in_metres(kept(u, v));
    }
  }
  return depth_m;
}

}  // namespace

struct LivePage::State {
  std::shared_ptr<const Robot> robot;
  std::size_t cameras;
  int stride;
  PageServer server;
  Curves curves{kMostLiveColumns, 0};
  std::chrono::steady_clock::time_point told = {};
  std::vector<std::shared_ptr<const Frame>> shown = {};
};

LivePage::LivePage(std::shared_ptr<const Robot> robot, const std::vector<PageCamera>& cameras,
                   const PageAddress& address, PageFiles files)
    : state_(new State{std::move(robot), cameras.size(), shown_stride(cameras),
                       PageServer(address, std::move(files), [](const std::string&) {})}) {
  const RobotModel& model = state_->robot->model();
  state_->shown.resize(cameras.size());
  state_->server.publish("scene", scene_message("running robot", model, cameras, {}));
  state_->server.publish("mesh", mesh_message(model));
}

LivePage::~LivePage() = default;

std::string LivePage::url() const { return state_->server.url(); }

void LivePage::show(const Result& result, const std::vector<std::shared_ptr<const Frame>>& frames) {
  if (frames.size() != state_->cameras) {
    throw std::invalid_argument(
        fmt::format("{} frames; expected {}, one for each camera", frames.size(), state_->cameras));
  }
  std::vector<const Frame*> pointers;
  for (const auto& frame : frames) pointers.push_back(frame.get());
  state_->server.publish("shown", shown_message(state_->robot->model(), result, pointers));
  for (std::size_t c = 0; c < frames.size(); ++c) {
    if (!frames[c] || frames[c] == state_->shown[c]) continue;
    state_->server.publish(
        fmt::format("image {}", c),
        image_message(c, 0, sensor_depth_of(*frames[c]), *frames[c], state_->stride));
  }
  state_->shown = frames;
  state_->curves.add(result);
  const auto now = std::chrono::steady_clock::now();
  if (now - state_->told < kBetweenCurves) return;
  state_->told = now;
  state_->server.publish("timeline", state_->curves.message());
}

}  // namespace berth::app
