#include "berth/distance/mesh_distances.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "berth/distance/last_request.hpp"
#include "berth/distance/link_search.hpp"

namespace berth {

void validate(const DistanceSettings& settings) {
  visit_settings(settings, SettingCheck{"evaluation"});
}

void validate(const MeshRequest& request) {
  const SettingCheck check{"evaluation"};
  check({"range_m", kRange, ""}, request.range_m);
  check({"tolerance_m", kNotNegative, ""}, request.tolerance_m);
  check({"deadline_us", {.may_be_infinite = true}, ""}, request.deadline_us);
}

namespace {

using Clock = std::chrono::steady_clock;
using mesh::keep_front;
using mesh::keep_pair;
using mesh::kFinestTolerance_m;
using mesh::LinkSearch;
using mesh::start;

struct LinkState {
  LinkSearch reading;
  LinkSearch nearest;
  /// Whether `nearest` goes on where it ended.
  bool goes_on = false;
  /// The last answer's pair.
  SpacePair last;
};

constexpr int kEndless = 1 << 30;

struct Asked {
  const UnknownSpace& space;
  const MeshRequest& request;
  /// With one view nothing is seen free by another one: hidden is all that lies behind a reading.
  bool is_shadow() const { return space.is_shadow(); }
  bool is_stopped() const { return request.stop && request.stop->stop_requested(); }
};

/// A reading is an obstacle for `nearest` as well.
void take_reading(const LinkSearch& reading, LinkSearch& nearest) {
  if (!reading.is_known() || !(reading.best_m < nearest.best_m)) return;
  nearest.best_m = reading.best_m;
  nearest.best_triangle = reading.best_triangle;
  nearest.best_pixel = reading.best_pixel;
  nearest.best_is_hidden = false;
}

/// The last answer's pixel as it is in the new image, its surface layer or with `to_shadow` all
/// behind its reading, against the whole link.
void guess(const UnknownSpace& space, const SpacePair& last, bool to_shadow, LinkSearch& search) {
  if (search.link->empty() || last.camera < 0 ||
      last.camera >= static_cast<int>(space.views().size())) {
    return;
  }
  const CameraSpace& view = *(to_shadow ? space.shadow_view() : space.views()[last.camera]).space;
  const Pixel pixel = last.obstacle_pixel;
  if (pixel.u < 0 || pixel.v < 0 || pixel.u >= view.camera.width_px ||
      pixel.v >= view.camera.height_px) {
    return;
  }
  if (std::isnan(view.obstacle_depth_m(pixel.u, pixel.v))) return;
  const int top_level = static_cast<int>(search.link->levels.size()) - 1;
  search.items.clear();
  search.items.push(
      {0, mesh::patch_of(top_level, 0),
       mesh::ImageCell{last.camera, mesh::ImageCell::kPixelLevel, 0, pixel.u, pixel.v}.key()});
  // To the end, whatever is known: asked again, an answer becomes no worse.
  const float known_bound_m = std::exchange(search.known_bound_m, 0.0f);
  const float tolerance_m = std::exchange(search.tolerance_m, kFinestTolerance_m);
  mesh::search_views(space, to_shadow, kEndless, search);
  search.known_bound_m = known_bound_m;
  search.tolerance_m = tolerance_m;
}

void start_nearest(const Asked& asked, LinkState& link) {
  take_reading(link.reading, link.nearest);
  if (link.goes_on && asked.is_shadow()) {
    link.nearest.front.take_below(link.nearest.limit_m(), link.nearest.items);
  } else if (link.goes_on) {
    mesh::take_cubes_below(link.nearest);
  } else if (asked.is_shadow()) {
    guess(asked.space, link.last, true, link.nearest);
    mesh::start_in_views(asked.space, link.nearest);
  } else {
    if (link.last.obstacle_is != ObstacleKind::occupied) {
      mesh::try_hidden_point(asked.space, link.last.obstacle_point_B_m, link.nearest);
    }
    mesh::start_in_cubes(link.nearest);
  }
  if (link.nearest.is_beyond_cubes) link.nearest.given_up_m = 0;
}

void search_reading(const Asked& asked, int steps, LinkState& link) {
  mesh::search_views(asked.space, false, steps, link.reading);
}

void search_nearest(const Asked& asked, int steps, LinkState& link) {
  if (asked.is_shadow()) {
    mesh::search_views(asked.space, true, steps, link.nearest);
  } else {
    mesh::search_cubes(asked.space, steps, link.nearest);
  }
}

/// One of a link's searches, until it is done or somebody stops it.
template <class Search>
void search_on(const Asked& asked, const LinkSearch& searched, Search search) {
  // Less than a millisecond.
  constexpr int kSteps = 256;
  do {
    search(kSteps);
  } while (!searched.is_done() && !asked.is_stopped());
}

void search_to_the_end(const Asked& asked, LinkState& link) {
  if (link.reading.link->empty()) return;
  search_on(asked, link.reading, [&](int steps) { search_reading(asked, steps, link); });
  if (!asked.request.unknown) return;
  start_nearest(asked, link);
  search_on(asked, link.nearest, [&](int steps) { search_nearest(asked, steps, link); });
}

/// How far its bounds are apart; 0 where that is near enough.
double gap_m(const LinkSearch& search) {
  return search.is_done() ? 0 : search.best_m - search.lower_bound_m();
}

/// One of a link's two searches.
struct Turn {
  LinkState* link = nullptr;
  bool is_reading = true;

  double gap_m() const {
    if (link == nullptr) return 0;
    return berth::gap_m(is_reading ? link->reading : link->nearest);
  }
};

/// The search that knows least; none where all are done.
Turn widest_of(const Asked& asked, std::vector<LinkState>& links) {
  Turn widest;
  for (LinkState& link : links) {
    if (link.reading.link->empty()) continue;
    for (const bool is_reading : {true, false}) {
      const Turn turn{&link, is_reading};
      if (!is_reading && !asked.request.unknown) continue;
      if (turn.gap_m() > widest.gap_m()) widest = turn;
    }
  }
  return widest;
}

/// Goes on where the least is known, until everything is, time is over or somebody stops it.
void search_until(const Asked& asked, Clock::time_point deadline, std::vector<LinkState>& links) {
  constexpr int kSteps = 8;
  if (asked.request.unknown) {
    for (LinkState& link : links) {
      if (!link.reading.link->empty()) start_nearest(asked, link);
    }
  }
  do {
    const Turn turn = widest_of(asked, links);
    if (turn.link == nullptr) return;
    if (turn.is_reading) {
      search_reading(asked, kSteps, *turn.link);
      take_reading(turn.link->reading, turn.link->nearest);
    } else {
      search_nearest(asked, kSteps, *turn.link);
    }
  } while (Clock::now() < deadline && !asked.is_stopped());
}

WholeLinkDistance answer_of(const Asked& asked, LinkId id, LinkState& link) {
  WholeLinkDistance out;
  out.id = id;
  if (link.reading.link->empty()) {
    out.nearest.lower_bound_m = out.occupied.lower_bound_m = link.reading.range_m;
    return out;
  }
  out.occupied = mesh::pair_of(asked.space, false, link.reading);
  out.nearest = out.occupied;
  if (asked.request.unknown) {
    out.nearest = mesh::pair_of(asked.space, asked.is_shadow(), link.nearest);
    if (!asked.is_shadow()) {
      out.nearest.lower_bound_m = std::min(out.nearest.lower_bound_m, out.occupied.lower_bound_m);
    }
  }
  mesh::reconcile(out);
  return out;
}

}  // namespace

struct MeshWorkspace::State {
  std::vector<LinkState> links;
  mesh::LastRequest last;
};

MeshWorkspace::MeshWorkspace() : state_(std::make_unique<State>()) {}
MeshWorkspace::~MeshWorkspace() = default;
MeshWorkspace::MeshWorkspace(const MeshWorkspace& other)
    : state_(std::make_unique<State>(*other.state_)) {}
MeshWorkspace& MeshWorkspace::operator=(const MeshWorkspace& other) {
  *state_ = *other.state_;
  return *this;
}
MeshWorkspace::MeshWorkspace(MeshWorkspace&&) noexcept = default;
MeshWorkspace& MeshWorkspace::operator=(MeshWorkspace&&) noexcept = default;
void MeshWorkspace::forget() { state_->last.links.clear(); }

namespace {

bool is_about(const mesh::LastRequest& last, const RobotPatches& robot, const UnknownSpace& space) {
  return last.robot == robot.serial_number && last.space == space.serial_number() &&
         last.links.size() == robot.links.size();
}

/// What no link can have come nearer than since the last request.
void recall(const mesh::LastLink& last, float moved_m, LinkState& link) {
  const float range_m = link.reading.range_m;
  link.reading.known_bound_m = std::clamp(last.reading_bound_m - moved_m, 0.0f, range_m);
  link.nearest.known_bound_m = std::clamp(last.nearest_bound_m - moved_m, 0.0f, range_m);
}

/// Goes on from the request before, which was about the same space. Returns whether the search of
/// readings does.
bool go_on(const mesh::LastLink& last, LinkState& link) {
  const float moved_m = mesh::moved_at_most_m(*link.reading.link, last.X_BL, link.reading.X_BL);
  recall(last, moved_m, link);
  link.goes_on = keep_front(moved_m, link.nearest);
  return keep_front(moved_m, link.reading);
}

void remember(const RobotPatches& robot, const UnknownSpace& space, bool hidden,
              const std::vector<LinkState>& links, mesh::LastRequest& last) {
  last.robot = robot.serial_number;
  last.space = space.serial_number();
  last.links.resize(links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    const LinkState& link = links[i];
    if (link.reading.link->empty()) continue;
    last.links[i] = {link.reading.X_BL, link.reading.lower_bound_m(),
                     hidden ? link.nearest.lower_bound_m() : 0};
  }
}

/// With the last answer's pairs for a first guess.
void start_links(const RobotPatches& robot, const RobotPose& pose, const Asked& asked,
                 const mesh::LastRequest& last, const std::vector<WholeLinkDistance>& last_answer,
                 std::vector<LinkState>& links) {
  const bool is_same = is_about(last, robot, asked.space);
  links.resize(robot.links.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    LinkState& link = links[i];
    const Pose& X_BL = pose.X_BL[robot.links[i].link];
    start(robot.links[i], X_BL, asked.request, link.reading);
    start(robot.links[i], X_BL, asked.request, link.nearest);
    link.goes_on = false;
    const bool reading_goes_on = is_same && go_on(last.links[i], link);
    for (auto& [search, goes_on] : {std::pair<LinkSearch&, bool>{link.reading, reading_goes_on},
                                    {link.nearest, link.goes_on}}) {
      if (!goes_on) {
        search.best_triangle = -1;
        // Also where nobody searches it now: it would be taken for this request's the next time.
        mesh::begin_front(search);
      }
      keep_pair(search);
    }
    const WholeLinkDistance guessed = i < last_answer.size() ? last_answer[i] : WholeLinkDistance{};
    link.last = guessed.nearest;
    if (reading_goes_on) {
      link.reading.front.take_below(link.reading.limit_m(), link.reading.items);
    } else {
      guess(asked.space, guessed.occupied, false, link.reading);
      mesh::start_in_views(asked.space, link.reading);
    }
  }
}

}  // namespace

void mesh_distances(const RobotPatches& robot, const RobotPose& pose, const UnknownSpace& space,
                    const MeshRequest& request, MeshWorkspace& workspace,
                    std::vector<WholeLinkDistance>& out) {
  const Clock::time_point begin = Clock::now();
  validate(request);
  const Asked asked{space, request};
  std::vector<LinkState>& links = workspace.state_->links;
  start_links(robot, pose, asked, workspace.state_->last, out, links);
  if (request.deadline_us) {
    const std::chrono::duration<double, std::micro> wait(std::min(*request.deadline_us, 1e12));
    search_until(asked, begin + std::chrono::duration_cast<Clock::duration>(wait), links);
  } else {
    tbb::parallel_for(std::size_t{0}, links.size(),
                      [&](std::size_t i) { search_to_the_end(asked, links[i]); });
  }
  remember(robot, space, request.unknown, links, workspace.state_->last);
  out.resize(robot.links.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = answer_of(asked, static_cast<LinkId>(i + 1), links[i]);
  }
}

}  // namespace berth
