#include "thesis/opengl/gl_lattice_search.hpp"

#include <algorithm>
#include <utility>

#include "thesis/opengl/gl_metric.hpp"

namespace berth {
namespace {

/// Bytes of the struct of closest_pair.glsl.
constexpr std::size_t kLatticePairBytes = 20;

/// Each goes on to further links where there are more.
constexpr int kMostLinkGroups = 256;

/// Enough workgroups for a large GPU, and some pixels for each invocation of them.
unsigned slices_of(int width, int height, PixelStep step) {
  constexpr std::int64_t kSlicePixels = 2048;
  constexpr std::int64_t kMostSlices = 64;
  const std::int64_t columns = (width + step.x - 1) / step.x;
  const std::int64_t rows = (height + step.y - 1) / step.y;
  return static_cast<unsigned>(
      std::clamp<std::int64_t>(columns * rows / kSlicePixels, 1, kMostSlices));
}

}  // namespace

GlLatticeSearch::GlLatticeSearch() : finish_program_("lattice_finish.comp.glsl") {}

void GlLatticeSearch::begin(const Camera& camera, int link_count, const GlTexture& obstacle_depth_m,
                            const ImageDistanceSettings& settings, const GlBuffer& link_pixels) {
  obstacle_depth_m_ = &obstacle_depth_m;
  link_pixels_ = &link_pixels;
  settings_ = settings;
  intrinsics_ = gl_intrinsics(metric_of(camera));
  link_count_ = link_count;
  slices_ = 0;
  answers_.prepare(camera, link_count);
  const std::size_t links = link_count;
  const std::size_t most_pairs = links * slices_of(camera.width_px, camera.height_px, {1, 1});
  take_at_least(links * 2 * sizeof(std::uint32_t), link_pairs_);
  take_at_least(most_pairs * kLatticePairBytes, former_closest_);
  take_at_least(most_pairs * kLatticePairBytes, slice_closest_);
  link_pairs_.fill(0);
}

void GlLatticeSearch::run(GlProgram& program, PixelStep step) {
  const unsigned slices = slices_of(obstacle_depth_m_->width(), obstacle_depth_m_->height(), step);
  std::swap(former_closest_, slice_closest_);
  program.set("intrinsics", intrinsics_);
  program.set("step_px", Eigen::Vector2i(step.x, step.y));
  program.set("farthest_m2", gl_farthest_m2(settings_.range_m));
  program.set("former_slices", slices_);
  program.set("link_count", static_cast<unsigned>(link_count_));
  program.read("obstacle_depth_m", *obstacle_depth_m_);
  program.bind("LinkPixels", *link_pixels_);
  program.bind("LinkPairs", link_pairs_);
  program.bind("FormerClosest", former_closest_);
  program.bind("SliceClosest", slice_closest_);
  program.dispatch(static_cast<int>(slices), std::min(link_count_, kMostLinkGroups));
  slices_ = slices;
}

const GlBuffer& GlLatticeSearch::answers() {
  finish_program_.set("image_size",
                      Eigen::Vector2i(obstacle_depth_m_->width(), obstacle_depth_m_->height()));
  finish_program_.set("slices", slices_);
  finish_program_.set("link_count", static_cast<unsigned>(link_count_));
  answers_.set_region(finish_program_, settings_.range_m);
  finish_program_.bind("LinkPixels", *link_pixels_);
  finish_program_.bind("LinkPairs", link_pairs_);
  finish_program_.bind("SliceClosest", slice_closest_);
  finish_program_.bind("LinkAnswers", answers_.device());
  finish_program_.dispatch(std::min(link_count_, kMostLinkGroups));
  return answers_.device();
}

void GlLatticeSearch::finish(LinkDistances& out) {
  answers();
  answers_.finish(*obstacle_depth_m_, settings_, false, out);
}

}  // namespace berth
