#include "thesis/opengl/gl_link_answers.hpp"

#include "thesis/closest_pair.hpp"
#include "thesis/opengl/gl_metric.hpp"

namespace berth {
namespace {

/// Workgroups that share the pixels around a link; their sums are added here.
constexpr int kParts = 32;

}  // namespace

GlLinkAnswers::GlLinkAnswers() : mean_direction_("mean_direction.comp.glsl") {}

void GlLinkAnswers::prepare(const Camera& camera, int link_count) {
  camera_ = camera;
  link_count_ = link_count;
  const std::size_t answer_bytes = link_count * sizeof(GlLinkAnswer);
  if (answer_bytes > answers_.bytes() || answers_.name() == 0) {
    const std::size_t sum_bytes = link_count * kParts * sizeof(Eigen::Vector4f);
    answers_ = {answer_bytes, GlMemory::device};
    answers_back_ = {answer_bytes, GlMemory::read_back};
    sums_ = {sum_bytes, GlMemory::device};
    sums_back_ = {sum_bytes, GlMemory::read_back};
    mean_direction_.bind("LinkAnswers", answers_);
    mean_direction_.bind("DirectionSums", sums_);
  }
  mean_direction_.set("intrinsics", gl_intrinsics(metric_of(camera)));
}

void GlLinkAnswers::set_region(GlProgram& program, double range_m) const {
  program.set("pinhole", Eigen::Vector4d(camera_.corner_cx_px(), camera_.corner_cy_px(),
                                         camera_.fx_px, camera_.fy_px));
  program.set("range_m", range_m);
}

void GlLinkAnswers::finish(const GlTexture& obstacle_depth_m, const ImageDistanceSettings& settings,
                           bool certifies, LinkDistances& out) {
  out.links.resize(link_count_);
  out.pairs = 0;
  if (link_count_ == 0) return;
  if (settings.mean_direction) {
    mean_direction_.read("obstacle_depth_m", obstacle_depth_m);
    mean_direction_.dispatch(kParts, link_count_);
    sums_.copy_to(sums_back_, sums_.bytes());
  }
  answers_.copy_to(answers_back_, answers_.bytes());
  done_.set();
  done_.wait();
  for (int i = 0; i < link_count_; ++i) {
    read_link(i, settings, certifies, out.links[i]);
    if (settings.mean_direction && out.links[i].status == LinkStatus::ok) {
      read_direction(i, out.links[i]);
    }
    const GlLinkAnswer& answer = answers_back_.mapped<GlLinkAnswer>()[i];
    out.pairs += static_cast<std::int64_t>(answer.pairs_hi) << 32 | answer.pairs_lo;
  }
}

void GlLinkAnswers::read_link(int link, const ImageDistanceSettings& settings, bool certifies,
                              LinkDistance& out) {
  const GlLinkAnswer& answer = answers_back_.mapped<GlLinkAnswer>()[link];
  const Metric metric = metric_of(camera_);
  const auto range_m = static_cast<float>(settings.range_m);
  ClosestPair pair = no_pair_within(range_m);
  if (has_pair(answer)) {
    const Pixel robot = unpacked_pixel(answer.robot);
    const Pixel obstacle = unpacked_pixel(answer.obstacle);
    pair = {0,
            static_cast<float>(robot.u),
            static_cast<float>(robot.v),
            answer.robot_depth_m,
            static_cast<float>(obstacle.u),
            static_cast<float>(obstacle.v),
            answer.obstacle_depth_m};
    pair.squared_m2 = squared_distance_m2(metric, pair.ru, pair.rv, pair.robot_depth_m, pair.ou,
                                          pair.ov, pair.obstacle_depth_m);
  }
  const auto id = static_cast<LinkId>(link + 1);
  out = link_distance(id, static_cast<int>(answer.robot_pixels), metric, pair, range_m);
  if (!certifies && answer.robot_pixels > 0) out.lower_bound_m = 0;
}

void GlLinkAnswers::read_direction(int link, LinkDistance& out) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  const auto sums = sums_back_.mapped<Eigen::Vector4f>().subspan(link * kParts, kParts);
  for (const Eigen::Vector4f& part : sums) sum += part.cast<double>();
  if (sum.w() == 0) return;
  out.mean_count = static_cast<std::int64_t>(sum.w());
  out.mean_direction_C = (sum.head<3>() / sum.w()).cast<float>();
}

}  // namespace berth
