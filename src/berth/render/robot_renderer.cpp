#include "berth/render/robot_renderer.hpp"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

#include "berth/render/draw_triangles.hpp"
#include "berth/render/link_meshes.hpp"
#include "berth/render/link_rect.hpp"

namespace berth {
namespace {

/// What a thread takes at a time, large enough to be worth taking.
constexpr std::size_t kChunkBlocks = 64;
constexpr std::size_t kChunksPerThread = 4;
constexpr std::size_t kMostThreads = 8;
constexpr int kShownRows = 64;

struct Chunk {
  std::size_t link;
  std::span<const TriangleBlock> blocks;
};

std::vector<Chunk> chunks_of(const LinkMeshes& meshes) {
  std::vector<Chunk> chunks;
  for (std::size_t link = 0; link < meshes.links().size(); ++link) {
    const std::span<const TriangleBlock> blocks(meshes.links()[link].blocks);
    for (std::size_t i = 0; i < blocks.size(); i += kChunkBlocks) {
      chunks.push_back({link, blocks.subspan(i, std::min(kChunkBlocks, blocks.size() - i))});
    }
  }
  return chunks;
}

/// What lies behind a surface by a lesser share of its depth is the same surface, drawn once more.
constexpr float kSameDepth = 1e-5F;

/// Gives the image its size. One that has it stays as it is.
void fit(const Camera& camera, RobotImage& image) {
  const auto fits = [&](const auto& pixels) {
    return pixels.width() == camera.width_px && pixels.height() == camera.height_px;
  };
  if (fits(image.depth_m) && fits(image.link_id)) return;
  image.depth_m.resize(camera.width_px, camera.height_px, kNoDepth);
  image.link_id.resize(camera.width_px, camera.height_px, kNoLink);
  image.extent = {};
}

}  // namespace

bool is_drawn(const Link& link, DrawnLinks drawn) {
  return drawn == DrawnLinks::environment ? link.role == LinkRole::environment
                                          : link.role != LinkRole::ignored;
}

std::shared_ptr<const LinkMeshes> build_link_meshes(const RobotModel& model, DrawnLinks drawn) {
  return std::make_shared<const LinkMeshes>(model, drawn);
}

struct RobotRenderer::State {
  std::shared_ptr<const LinkMeshes> meshes;
  Camera camera;
  std::vector<Chunk> chunks;
  std::vector<LinkInImage> views;
  /// One for each thread; the first of them have been drawn on.
  std::vector<Canvas> canvases;
  /// Of the canvases, where only what lies behind other surfaces is drawn.
  std::vector<float> ceilings;

  State(std::shared_ptr<const LinkMeshes> link_meshes, const Camera& c)
      : meshes(std::move(link_meshes)),
        camera(c),
        chunks(chunks_of(*meshes)),
        views(meshes->links().size()) {}

  /// Returns where the robot may be seen.
  PixelRect look(const RobotPose& pose, const Pose& X_CB) {
    PixelRect extent;
    for (std::size_t i = 0; i < views.size(); ++i) {
      const LinkMeshes::LinkMesh& mesh = meshes->links()[i];
      assert(mesh.link_index < pose.X_BL.size());
      const Pose X_CL = X_CB * pose.X_BL[mesh.link_index];
      views[i] = {mesh.id, project_box(mesh.box_L_m, X_CL, camera), to_pixel(camera, X_CL),
                  single_precision_from_m(camera, mesh.box_L_m)};
      extent = united(extent, views[i].rect);
    }
    return extent;
  }

  void set_ceilings(const RobotImage& first) {
    const auto pixels = static_cast<std::size_t>(camera.width_px) * camera.height_px;
    ceilings.assign(pixels + KeyImage::kPadding, 0);
    for (std::size_t i = 0; i < pixels; ++i) {
      if (first.link_id.pixels()[i] == kNoLink) continue;
      ceilings[i] = (1 - kSameDepth) / first.depth_m.pixels()[i];
    }
  }

  /// No more than the work and the putting together of their images are worth.
  int threads() const {
    const auto allowed =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const auto in_arena = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t most = std::min({allowed, in_arena, kMostThreads});
    return static_cast<int>(std::clamp<std::size_t>(chunks.size() / kChunksPerThread, 1, most));
  }

  void draw(int threads, bool is_behind) {
    while (canvases.size() < static_cast<std::size_t>(threads)) {
      canvases.push_back({KeyImage(camera.width_px, camera.height_px), false, {}, {}});
    }
    for (Canvas& canvas : canvases) canvas.keys.set_ceilings(is_behind ? ceilings.data() : nullptr);
    std::atomic<std::size_t> next = 0;
    const auto draw_on = [&](Canvas& canvas) {
      for (std::size_t i = next++; i < chunks.size(); i = next++) {
        const LinkInImage& view = views[chunks[i].link];
        if (!view.rect.empty()) draw_triangles(chunks[i].blocks, view, canvas);
      }
    };
    // The automatic partitioner may give all canvases to one thread.
    tbb::parallel_for(
        0, threads, [&](int thread) { draw_on(canvases[thread]); }, tbb::simple_partitioner());
  }

  void show(int threads, const PixelRect& extent, RobotImage& image) {
    const PixelRect before = clip(image.extent, camera.width_px, camera.height_px);
    const PixelRect all = united(extent, before);
    const auto drawn = std::span(canvases).first(threads);
    tbb::parallel_for(tbb::blocked_range<int>(all.v_begin, all.v_end, kShownRows),
                      [&](const tbb::blocked_range<int>& rows) {
                        for (int v = rows.begin(); v != rows.end(); ++v)
                          show_row(drawn, v, extent, before, image);
                      });
    for (Canvas& canvas : drawn) canvas.used = false;
  }

  void render(const RobotPose& pose, const Pose& X_BC, bool is_behind, RobotImage& image) {
    const PixelRect extent = look(pose, X_BC.inverse());
    const int most = threads();
    fit(camera, image);
    draw(most, is_behind);
    show(most, extent, image);
    image.extent = extent;
  }
};

RobotRenderer::RobotRenderer(std::shared_ptr<const LinkMeshes> meshes, const Camera& camera)
    : state_(std::make_unique<State>(std::move(meshes), checked(camera))) {}
RobotRenderer::~RobotRenderer() = default;
RobotRenderer::RobotRenderer(RobotRenderer&&) noexcept = default;
RobotRenderer& RobotRenderer::operator=(RobotRenderer&&) noexcept = default;

void RobotRenderer::render(const RobotPose& pose, const Pose& X_BC, RobotImage& image) {
  require_finite(X_BC);
  state_->render(pose, X_BC, false, image);
}

void RobotRenderer::render_behind(const RobotPose& pose, const Pose& X_BC, const RobotImage& first,
                                  RobotImage& image) {
  require_finite(X_BC);
  assert(first.link_id.width() == state_->camera.width_px &&
         first.link_id.height() == state_->camera.height_px);
  state_->set_ceilings(first);
  state_->render(pose, X_BC, true, image);
}

const Camera& checked(const Camera& camera) {
  const bool focal_ok = camera.fx_px > 0 && camera.fy_px > 0 && std::isfinite(camera.fx_px) &&
                        std::isfinite(camera.fy_px);
  if (camera.width_px <= 0 || camera.height_px <= 0 || !focal_ok || !std::isfinite(camera.cx_px) ||
      !std::isfinite(camera.cy_px)) {
    throw std::invalid_argument(fmt::format(
        "camera: {} x {} px, fx {}, fy {}, cx {}, cy {}; expected a positive size and "
        "positive focal lengths, all finite",
        camera.width_px, camera.height_px, camera.fx_px, camera.fy_px, camera.cx_px, camera.cy_px));
  }
  return camera;
}

void require_finite(const Pose& X_BC) {
  if (X_BC.matrix().allFinite()) return;
  throw std::invalid_argument(fmt::format("pose of the camera at {} {} {}: expected finite numbers",
                                          X_BC.translation().x(), X_BC.translation().y(),
                                          X_BC.translation().z()));
}

}  // namespace berth
