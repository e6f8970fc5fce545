#include "thesis/opengl/gl_self_filter.hpp"

#include <algorithm>

#include "thesis/opengl/gl_tolerance.hpp"

namespace berth {
namespace {

constexpr int kFilterTilePx = 16;

/// Bytes of the structs of filter_tile.glsl.
constexpr std::size_t kTileBytes = 8;
constexpr std::size_t kDiscBytes = 32;

Eigen::Vector2d focal_px(const Camera& camera) { return {camera.fx_px, camera.fy_px}; }

/// outline_of's limit of a neighbour's depth.
float deeper(const Camera& camera) {
  return 1 + static_cast<float>(1 / std::max(camera.fx_px, camera.fy_px));
}

bool may_pad(const SelfFilterSettings& settings) {
  return settings.padding_m > 0 || settings.padding_of(kEnvironmentLink) > 0 ||
         std::any_of(settings.link_padding_m.begin(), settings.link_padding_m.end(),
                     [](double padding_m) { return padding_m > 0; });
}

}  // namespace

GlSelfFilter::GlSelfFilter()
    : pixels_program_("filter_pixels.comp.glsl"),
      grow_program_("filter_grow.comp.glsl"),
      finish_program_("filter_finish.comp.glsl"),
      counts_(device_buffer(kPixelFateCount * sizeof(std::uint32_t))),
      counts_back_(kPixelFateCount * sizeof(std::uint32_t), GlMemory::read_back) {
  finish_program_.bind("FateCounts", counts_);
}

void GlSelfFilter::filter(const Camera& camera, const GlTexture& sensor_depth_m,
                          const GlRobotImage& robot, const SelfFilterSettings& settings,
                          const GlObstacleImage& out) {
  filter(camera, Images{sensor_depth_m, robot, nullptr, out}, settings);
}

void GlSelfFilter::filter(const Camera& camera, const GlTexture& sensor_depth_m,
                          const GlRobotImage& robot, const GlTexture& region_id,
                          const SelfFilterSettings& settings, const GlObstacleImage& out) {
  filter(camera, Images{sensor_depth_m, robot, &region_id, out}, settings);
}

void GlSelfFilter::filter(const Camera& camera, const Images& images,
                          const SelfFilterSettings& settings) {
  validate(settings);
  require_region(settings, images.region_id != nullptr);
  prepare(camera);
  set_paddings(settings);
  look_at_pixels(camera, images, settings);
  if (may_pad(settings)) pad(images);
  judge_pieces(camera, images, settings);
  finish(images);
}

void GlSelfFilter::prepare(const Camera& camera) {
  const Eigen::Vector2i size(camera.width_px, camera.height_px);
  if (size == size_) return;
  size_ = size;
  tiles_ = (size.array() + (kFilterTilePx - 1)) / kFilterTilePx;
  take_memory();
}

void GlSelfFilter::take_memory() {
  const auto tiles = static_cast<std::size_t>(tiles_.prod());
  filter_tiles_ = device_buffer(tiles * kTileBytes);
  discs_ = device_buffer(tiles * kFilterTilePx * kFilterTilePx * kDiscBytes);
  frame_ = device_buffer(sizeof(std::uint32_t));
  upload_.emplace(size_.x(), size_.y());
  for (GlProgram* program : {&pixels_program_, &grow_program_}) {
    program->bind("FilterTiles", filter_tiles_);
    program->bind("FilterFrame", frame_);
    program->bind("Discs", discs_);
  }
}

void GlSelfFilter::set_paddings(const SelfFilterSettings& settings) {
  std::size_t count = settings.link_padding_m.size();
  const auto is_same = [&](std::size_t i) {
    return link_padding_m_[i] == settings.padding_of(static_cast<LinkId>(i + 1));
  };
  bool same = link_paddings_.name() != 0 && count == link_padding_m_.size();
  for (std::size_t i = 0; same && i < count; ++i) same = is_same(i);
  pixels_program_.set("padding_m", settings.padding_m);
  pixels_program_.set("environment_padding_m", settings.padding_of(kEnvironmentLink));
  pixels_program_.set("padding_depth_m", static_cast<float>(settings.padding_depth_m));
  if (same) return;
  link_padding_m_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    link_padding_m_[i] = settings.padding_of(static_cast<LinkId>(i + 1));
  }
  const std::size_t bytes = count * sizeof(double);
  GlBuffer staging(bytes, GlMemory::upload);
  std::copy(link_padding_m_.begin(), link_padding_m_.end(), staging.mapped<double>().begin());
  link_paddings_ = device_buffer(bytes);
  staging.copy_to(link_paddings_, bytes);
  pixels_program_.bind("LinkPadding", link_paddings_);
  pixels_program_.set("link_paddings", static_cast<int>(count));
}

void GlSelfFilter::look_at_pixels(const Camera& camera, const Images& images,
                                  const SelfFilterSettings& settings) {
  frame_.fill(0);
  pixels_program_.read("sensor_depth_m", images.sensor_depth_m);
  pixels_program_.read("robot_depth_m", images.robot.depth_m);
  pixels_program_.read("link_id", images.robot.link_id);
  pixels_program_.write("fate", images.out.fate);
  for (GlProgram* program : {&pixels_program_, &grow_program_}) {
    program->set("focal_px", focal_px(camera));
  }
  pixels_program_.set("tolerance", gl_tolerance(tolerance_of(settings)));
  pixels_program_.set("deeper", deeper(camera));
  dispatch(pixels_program_);
}

void GlSelfFilter::pad(const Images& images) {
  grow_program_.read("sensor_depth_m", images.sensor_depth_m);
  grow_program_.write("fate", images.out.fate);
  dispatch(grow_program_);
}

void GlSelfFilter::judge_pieces(const Camera& camera, const Images& images,
                                const SelfFilterSettings& settings) {
  read_back(images.sensor_depth_m, sensor_depth_m_);
  read_back(images.robot, robot_);
  read_back(images.out.fate, obstacles_);
  obstacles_.depth_m = sensor_depth_m_;
  berth::judge_pieces(camera, sensor_depth_m_, robot_, settings, workspace_, obstacles_);
  upload_->send(obstacles_.fate, images.out.fate);
}

void GlSelfFilter::finish(const Images& images) {
  counts_.fill(0);
  finish_program_.read("sensor_depth_m", images.sensor_depth_m);
  // A sampler needs a texture, also where it is not read.
  finish_program_.read("region_id",
                       images.region_id != nullptr ? *images.region_id : images.robot.link_id);
  finish_program_.write("fate", images.out.fate);
  finish_program_.write("obstacle_depth_m", images.out.depth_m);
  finish_program_.set("has_region", images.region_id != nullptr ? 1 : 0);
  dispatch(finish_program_);
  counts_.copy_to(counts_back_, counts_.bytes());
  counted_.set();
}

std::array<std::int64_t, kPixelFateCount> GlSelfFilter::count() {
  counted_.wait();
  std::array<std::int64_t, kPixelFateCount> count{};
  const auto found = counts_back_.mapped<std::uint32_t>();
  std::copy(found.begin(), found.end(), count.begin());
  return count;
}

}  // namespace berth
