#include "berth/distance/lattice/lattice.hpp"

#include <cassert>
#include <span>

#include "berth/distance/surveillance.hpp"

namespace berth {
namespace {

/// What all links have in common.
struct Question {
  const Surveillance& surveillance;
  const DepthImage& robot_depth_m;
  const LatticeSettings& settings;
};

/// The search for one link's closest pair.
class LinkSearch {
 public:
  /// `best` is no_pair_within() of the range.
  LinkSearch(const Question& question, LinkLattice& lattice, ClosestPair& best)
      : question_(question), lattice_(lattice), best_(best) {}

  /// Returns the number of pairs.
  std::int64_t run() {
    const PixelStep skipping{question_.settings.step_x, question_.settings.step_y};
    const int final_px = question_.settings.final_grid_radius_px;
    int radius_px = question_.settings.initial_grid_radius_px;
    std::int64_t pairs = try_points(lattice_.of_link(radius_px), skipping);
    while (has_pair() && radius_px > final_px) {
      const int former_px = radius_px;
      radius_px = finer_radius_px(radius_px, final_px);
      pairs += try_points(lattice_.within({closest(), former_px}, radius_px), skipping);
    }
    // Circles of radius 0 block no other pixel.
    if (has_pair()) pairs += try_points(lattice_.within({closest(), radius_px}, 0), {1, 1});
    return pairs;
  }

 private:
  bool has_pair() const { return best_.ru >= 0; }
  Pixel closest() const { return {static_cast<int>(best_.ru), static_cast<int>(best_.rv)}; }

  std::int64_t try_points(const std::vector<Pixel>& points, PixelStep step) {
    std::int64_t pairs = 0;
    for (const Pixel point : points) {
      pairs += search_around(question_.surveillance, point,
                             question_.robot_depth_m(point.u, point.v), step, best_);
    }
    return pairs;
  }

  const Question& question_;
  LinkLattice& lattice_;
  ClosestPair& best_;
};

/// Returns the number of pairs.
std::int64_t search_link(const Question& question, std::span<const Pixel> pixels,
                         LinkLattice& lattice, ClosestPair& best) {
  if (pixels.empty()) return 0;
  lattice.begin(pixels);
  const std::int64_t pairs = LinkSearch(question, lattice, best).run();
  lattice.end();
  return pairs;
}

}  // namespace

void lattice(const Camera& camera, const RobotImage& robot, DepthView obstacle_depth_m,
             int link_count, const DistanceSettings& settings, LatticeWorkspace& workspace,
             LinkDistances& out) {
  validate(settings);
  assert(robot.depth_m.width() == obstacle_depth_m.width);
  assert(robot.depth_m.height() == obstacle_depth_m.height);
  const Metric metric = metric_of(camera);
  const Surveillance surveillance = surveillance_of(camera, metric, obstacle_depth_m, settings,
                                                    SurveillanceRegion::cube_projection);
  const auto range_m = static_cast<float>(settings.range_m);
  workspace.pixels.sort(robot, link_count);
  workspace.lattice.reset(obstacle_depth_m.width, obstacle_depth_m.height);

  out.pairs = 0;
  out.links.resize(link_count);
  for (int i = 0; i < link_count; ++i) {
    const std::span<const Pixel> pixels = workspace.pixels.of(i);
    const auto count = static_cast<int>(pixels.size());
    ClosestPair best = no_pair_within(range_m);
    out.pairs += search_link({surveillance, robot.depth_m, settings.lattice}, pixels,
                             workspace.lattice, best);
    out.links[i] = link_distance(static_cast<LinkId>(i + 1), count, metric, best, range_m);
    if (count > 0) out.links[i].lower_bound_m = 0;
  }
}

}  // namespace berth
