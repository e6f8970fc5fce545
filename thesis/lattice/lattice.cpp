#include "thesis/lattice/lattice.hpp"

#include <cassert>
#include <span>

#include "thesis/surveillance.hpp"

namespace berth {
namespace {

/// What all links have in common.
struct Task {
  const Surveillance& surveillance;
  const DepthImage& robot_depth_m;
  const LatticeSettings& settings;
};

/// The search for one link's closest pair.
class LinkSearch {
 public:
  /// `best` is no_pair_within() of the range.
  LinkSearch(const Task& task, LinkLattice& lattice, ClosestPair& best)
      : task_(task), lattice_(lattice), best_(best) {}

  /// Returns the number of pairs.
  std::int64_t run() {
    const PixelStep skipping{task_.settings.step_x, task_.settings.step_y};
    const int final_px = task_.settings.final_grid_radius_px;
    int radius_px = task_.settings.initial_grid_radius_px;
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
      pairs += search_around(task_.surveillance, point, task_.robot_depth_m(point.u, point.v), step,
                             best_);
    }
    return pairs;
  }

  const Task& task_;
  LinkLattice& lattice_;
  ClosestPair& best_;
};

/// Returns the number of pairs.
std::int64_t search_link(const Task& task, std::span<const Pixel> pixels, LinkLattice& lattice,
                         ClosestPair& best) {
  if (pixels.empty()) return 0;
  lattice.begin(pixels);
  const std::int64_t pairs = LinkSearch(task, lattice, best).run();
  lattice.end();
  return pairs;
}

}  // namespace

void lattice(const ImageRequest& request, LatticeWorkspace& workspace, LinkDistances& out) {
  validate(request.settings);
  const DepthView obstacle_depth_m = request.obstacles.depth_m();
  assert(request.robot.depth_m.width() == obstacle_depth_m.width);
  assert(request.robot.depth_m.height() == obstacle_depth_m.height);
  const Metric metric = metric_of(request.camera);
  const Surveillance surveillance =
      surveillance_of(request, metric, SurveillanceRegion::cube_projection);
  const Task task{surveillance, request.robot.depth_m, request.settings.lattice};
  const auto range_m = static_cast<float>(request.settings.range_m);
  workspace.pixels.sort(request.robot, request.link_count);
  workspace.lattice.reset(obstacle_depth_m.width, obstacle_depth_m.height);

  out.pairs = 0;
  out.links.resize(request.link_count);
  for (int i = 0; i < request.link_count; ++i) {
    const std::span<const Pixel> pixels = workspace.pixels.of(i);
    const auto count = static_cast<int>(pixels.size());
    ClosestPair best = no_pair_within(range_m);
    out.pairs += search_link(task, pixels, workspace.lattice, best);
    out.links[i] = link_distance(static_cast<LinkId>(i + 1), count, metric, best, range_m);
    if (count > 0) out.links[i].lower_bound_m = 0;
  }
}

}  // namespace berth
