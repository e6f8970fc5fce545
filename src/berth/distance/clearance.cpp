#include "berth/distance/clearance.hpp"

#include <algorithm>
#include <cmath>

#include "berth/distance/link_search.hpp"

namespace berth {
namespace {

using mesh::LinkSearch;

/// The pieces after which a search is given up: what it would still decide lies within
/// millimetres of what is needed.
constexpr int kMostSteps = 96;
/// Searched on in one go, before it is seen whether a pair was found.
constexpr int kStepsAtOnce = 12;
/// How finely cubes are told apart.
constexpr float kClearanceTolerance_m = 0.004f;

void start_clearance(const LinkPatches& link, const Pose& X_BL, double needed_m,
                     LinkSearch& search) {
  ++search.request;
  search.link = &link;
  search.X_BL = X_BL;
  search.range_m = std::nextafter(static_cast<float>(needed_m), HUGE_VALF);
  search.tolerance_m = kClearanceTolerance_m;
  search.known_bound_m = 0;
  search.given_up_m = std::numeric_limits<float>::infinity();
  search.best_m = search.range_m;
  search.best_triangle = -1;
  search.best_is_hidden = false;
}

/// Searches until one pair is nearer than the range, or none can be.
template <class Search>
Clearance decide(int most_steps, LinkSearch& search, Search search_on) {
  Clearance out;
  while (out.steps + kStepsAtOnce <= std::min(most_steps, kMostSteps)) {
    search_on(kStepsAtOnce);
    out.steps += kStepsAtOnce;
    if (search.is_known()) {
      out.nearest_m = search.best_m;
      return out;
    }
    if (search.is_done()) break;
  }
  out.is_clear = !search.is_beyond_cubes && search.lower_bound_m() >= search.range_m;
  return out;
}

}  // namespace

struct ClearanceWorkspace::State {
  LinkSearch search;
};

ClearanceWorkspace::ClearanceWorkspace() : state_(std::make_unique<State>()) {}
ClearanceWorkspace::~ClearanceWorkspace() = default;

Clearance find_clearance(const LinkPatches& link, const Pose& X_BL, const UnknownSpace& space,
                         const ClearanceRequest& request, ClearanceWorkspace& workspace) {
  if (link.empty()) return {.is_clear = true};
  LinkSearch& search = workspace.state_->search;
  // With one view nothing is seen free by another one: hidden is all that lies behind a reading,
  // and the readings are a part of that.
  const bool is_shadow = request.unknown && space.is_shadow();
  start_clearance(link, X_BL, request.needed_m, search);
  mesh::start_in_views(space, search);
  const Clearance readings = decide(request.most_steps, search, [&](int steps) {
    mesh::search_views(space, is_shadow, steps, search);
  });
  if (!readings.is_clear || is_shadow || !request.unknown) return readings;
  start_clearance(link, X_BL, request.needed_m, search);
  mesh::start_in_cubes(search);
  Clearance all = decide(request.most_steps - readings.steps, search,
                         [&](int steps) { mesh::search_cubes(space, steps, search); });
  all.steps += readings.steps;
  return all;
}

}  // namespace berth
