#include "berth/distance/lattice.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>

#include "berth/distance/surveillance.hpp"

namespace berth {
namespace {

template <class Visit>
void visit_robot_pixels(const RobotImage& robot, Visit visit) {
  const PixelRect rect = clip(robot.extent, robot.link_id.width(), robot.link_id.height());
  for (int v = rect.v_begin; v < rect.v_end; ++v) {
    const LinkId* ids = robot.link_id.row(v);
    for (int u = rect.u_begin; u < rect.u_end; ++u) {
      if (ids[u] != kNoLink && ids[u] != kEnvironmentLink) visit(ids[u], Pixel{u, v});
    }
  }
}

/// Fills the workspace's pixels by link, by counting.
void sort_pixels(const RobotImage& robot, int link_count, LatticeWorkspace& workspace) {
  std::vector<int>& first = workspace.first_pixel;
  first.assign(link_count + 2, 0);
  visit_robot_pixels(robot, [&](LinkId id, Pixel) {
    assert(id <= link_count);
    ++first[id + 1];
  });
  std::partial_sum(first.begin(), first.end(), first.begin());
  workspace.pixels.resize(first.back());
  // Moves first[id] from where the id's pixels begin to where they end, which is where those of
  // link number id begin.
  visit_robot_pixels(robot, [&](LinkId id, Pixel p) { workspace.pixels[first[id]++] = p; });
}

/// What all links have in common.
struct Question {
  const Surveillance& surveillance;
  const DepthImage& robot_depth_m;
  const LatticeSettings& settings;
};

/// The search for one link's closest pair.
class LinkSearch {
 public:
  /// `best` is no_pair_within() of the range. The workspace's sets hold the link's pixels.
  LinkSearch(const Question& question, LatticeWorkspace& workspace, ClosestPair& best)
      : question_(question), workspace_(workspace), best_(best) {}

  /// Returns the number of pairs.
  std::int64_t run(int v_begin) {
    const PixelStep skipping{question_.settings.step_x, question_.settings.step_y};
    int radius_px = question_.settings.initial_grid_radius_px;
    std::int64_t pairs = try_lattice(radius_px, v_begin, skipping);
    while (has_pair() && radius_px > question_.settings.final_grid_radius_px) {
      const int former_px = radius_px;
      radius_px = std::max(radius_px / 2, question_.settings.final_grid_radius_px);
      pairs += try_lattice_within(former_px, radius_px, skipping);
    }
    // Circles of radius 0 block no other pixel.
    if (has_pair()) pairs += try_lattice_within(radius_px, 0, {1, 1});
    return pairs;
  }

 private:
  bool has_pair() const { return best_.ru >= 0; }

  /// A finer lattice, inside a circle around the closest point.
  std::int64_t try_lattice_within(int former_px, int radius_px, PixelStep step) {
    const Pixel closest{static_cast<int>(best_.ru), static_cast<int>(best_.rv)};
    workspace_.candidates.insert_within({closest, former_px}, workspace_.link);
    return try_lattice(radius_px, std::max(closest.v - former_px, 0), step);
  }

  std::int64_t try_lattice(int radius_px, int v_begin, PixelStep step) {
    take_lattice(radius_px, v_begin, workspace_.candidates, workspace_.points);
    std::int64_t pairs = 0;
    for (const Pixel point : workspace_.points) {
      pairs += search_around(question_.surveillance, point,
                             question_.robot_depth_m(point.u, point.v), step, best_);
    }
    return pairs;
  }

  const Question& question_;
  LatticeWorkspace& workspace_;
  ClosestPair& best_;
};

/// Returns the number of pairs.
std::int64_t search_link(const Question& question, std::span<const Pixel> pixels,
                         LatticeWorkspace& workspace, ClosestPair& best) {
  if (pixels.empty()) return 0;
  for (const Pixel pixel : pixels) {
    workspace.link.insert(pixel);
    workspace.candidates.insert(pixel);
  }
  const std::int64_t pairs = LinkSearch(question, workspace, best).run(pixels.front().v);
  for (const Pixel pixel : pixels) workspace.link.erase(pixel);
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
  sort_pixels(robot, link_count, workspace);
  workspace.link.reset(obstacle_depth_m.width, obstacle_depth_m.height);
  workspace.candidates.reset(obstacle_depth_m.width, obstacle_depth_m.height);

  out.pairs = 0;
  out.links.resize(link_count);
  for (int i = 0; i < link_count; ++i) {
    const int begin = workspace.first_pixel[i];
    const int count = workspace.first_pixel[i + 1] - begin;
    ClosestPair best = no_pair_within(range_m);
    out.pairs += search_link({surveillance, robot.depth_m, settings.lattice},
                             {workspace.pixels.data() + begin, static_cast<std::size_t>(count)},
                             workspace, best);
    out.links[i] = link_distance(static_cast<LinkId>(i + 1), count, metric, best, range_m);
    if (count > 0) out.links[i].lower_bound_m = 0;
  }
}

}  // namespace berth
