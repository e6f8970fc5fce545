#include "thesis/opengl/gl_hybrid.hpp"

#include "thesis/opengl/gl_lattice_point.hpp"

namespace berth {

GlHybrid::GlHybrid()
    : search_points_program_("lattice_search_points.comp.glsl"),
      point_count_(sizeof(std::uint32_t), GlMemory::upload) {
  search_points_program_.bind("LatticePointCount", point_count_);
}

void GlHybrid::prepare(const RobotImage& robot, int link_count) {
  const int width = robot.depth_m.width();
  const int height = robot.depth_m.height();
  link_count_ = link_count;
  take_at_least(lattice_point_bytes(width, height), points_, GlMemory::upload);
  search_points_program_.bind("LatticePoints", points_);
  take_at_least(link_count * sizeof(std::uint32_t), link_pixels_, GlMemory::upload);
  take_at_least(link_count * sizeof(GlLinkAnswer), answers_back_, GlMemory::read_back);
  pixels_.sort(robot, link_count);
  lattice_.reset(width, height);
  for (int i = 0; i < link_count; ++i) {
    link_pixels_.mapped<std::uint32_t>()[i] = static_cast<std::uint32_t>(pixels_.of(i).size());
  }
}

void GlHybrid::list(int link, const std::vector<Pixel>& lattice, const RobotImage& robot) {
  for (const Pixel p : lattice) {
    points_.mapped<GlLatticePoint>()[listed_++] = {static_cast<std::uint32_t>(link),
                                                   packed_pixel(p), robot.depth_m(p.u, p.v), 0};
  }
}

void GlHybrid::list_links(const RobotImage& robot, int radius_px) {
  for (int i = 0; i < link_count_; ++i) {
    lattice_.begin(pixels_.of(i));
    list(i, lattice_.of_link(radius_px), robot);
    lattice_.end();
  }
}

void GlHybrid::list_closest(const RobotImage& robot, int former_px, int radius_px) {
  search_.answers().copy_to(answers_back_, link_count_ * sizeof(GlLinkAnswer));
  done_.set();
  done_.wait();
  for (int i = 0; i < link_count_; ++i) {
    const GlLinkAnswer& answer = answers_back_.mapped<GlLinkAnswer>()[i];
    if (!has_pair(answer)) continue;
    lattice_.begin(pixels_.of(i));
    list(i, lattice_.within({unpacked_pixel(answer.robot), former_px}, radius_px), robot);
    lattice_.end();
  }
}

void GlHybrid::search(PixelStep step) {
  point_count_.mapped<std::uint32_t>()[0] = listed_;
  search_.run(search_points_program_, step);
  listed_ = 0;
}

void GlHybrid::evaluate(const Camera& camera, const RobotImage& robot,
                        const GlTexture& obstacle_depth_m, int link_count,
                        const ImageDistanceSettings& settings, LinkDistances& out) {
  validate(settings);
  const LatticeSettings& lattice = settings.lattice;
  const PixelStep skipping{lattice.step_x, lattice.step_y};
  prepare(robot, link_count);
  search_.begin(camera, link_count, obstacle_depth_m, settings, link_pixels_);
  int radius_px = lattice.initial_grid_radius_px;
  list_links(robot, radius_px);
  search(skipping);
  while (radius_px > lattice.final_grid_radius_px) {
    const int former_px = radius_px;
    radius_px = finer_radius_px(radius_px, lattice.final_grid_radius_px);
    list_closest(robot, former_px, radius_px);
    search(skipping);
  }
  // Circles of radius 0 block no other pixel.
  list_closest(robot, radius_px, 0);
  search({1, 1});
  search_.finish(out);
}

}  // namespace berth
